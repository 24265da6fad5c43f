//! Words of a shell.

/// A word, quoted if necessary.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./=:,+%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_of_a_shell_are_quoted_where_they_need_it() {
        assert_eq!(quoted("force.0.softening=0.1"), "force.0.softening=0.1");
        assert_eq!(quoted("picture.eye=[1, 0, 0]"), "'picture.eye=[1, 0, 0]'");
        assert_eq!([quoted("it's"), quoted("")], [r"'it'\''s'", "''"]);
    }
}
