//! The one walker that checks tables against keys declared as data.

use crate::settings::{Key, Kind, Settings, Value};

use super::report::{Fault, Place, Report, listed, nearest, shorten};
use super::sections::SECTIONS;
use super::tree::{Data, Entry, Node};
use super::value;

/// Keys that were renamed: the old name, and the new one, which is suggested where it is a key.
const RENAMED: [(&str, &str); 2] = [("particle_radius", "particle_size"), ("radius", "size")];

/// A table of the scene, with the name that messages give it.
#[derive(Clone)]
pub(super) struct Table<'a> {
    pub(super) entries: &'a [Entry],
    /// Its header, or all of it if it is written inline.
    pub(super) place: &'a Place,
    /// For "… in [[force]] gravity".
    pub(super) name: String,
}

impl<'a> Table<'a> {
    /// The entry of a key.
    pub(super) fn get(&self, key: &str) -> Option<&'a Entry> {
        self.entries.iter().find(|e| e.key == key)
    }
    /// The same table under a more specific name.
    pub(super) fn named(&self, name: String) -> Self {
        Self { name, ..self.clone() }
    }
    /// Reads the table: every key is one of `keys`, or one of `own`, which the caller reads. Missing or invalid values get their defaults,
    /// so that reading continues; they are in the report.
    pub(super) fn settings(&self, keys: &[Key], own: &[&str], report: &mut Report) -> Settings {
        let mut settings = Settings::defaults(keys);
        settings.0.extend(self.presets(keys).map(|(_, (name, value))| (*name, value.clone())));
        for entry in self.entries {
            if let Some(key) = keys.iter().find(|k| k.name == entry.key) {
                if let Some(value) = value::read(&entry.node, key.name, key.kind, report) {
                    settings.0.insert(key.name, value);
                }
            } else if !own.contains(&entry.key.as_str()) {
                report.push(self.unknown(entry, keys, own));
            }
        }
        for key in keys.iter().filter(|k| k.default.is_none() && self.get(k.name).is_none()) {
            report.push(self.lacks(key.name, &key.kind.wanted(), key.about));
        }
        settings
    }
    /// The defaults that words of this table change, with the entries of these words.
    pub(super) fn presets<'b>(
        &'b self,
        keys: &'b [Key],
    ) -> impl Iterator<Item = (&'b Entry, &'static (&'static str, Value))> + 'b {
        keys.iter().filter(|key| !key.presets.is_empty()).flat_map(|key| {
            let entry = self.get(key.name);
            let word = entry.and_then(|entry| match &entry.node.data {
                Data::Text(word) => Some((entry, key.preset(word))),
                _ => None,
            });
            word.into_iter().flat_map(|(entry, all)| all.iter().map(move |one| (entry, one)))
        })
    }
    /// The fault of a required key that is missing.
    pub(super) fn lacks(&self, key: &str, wanted: &str, about: &str) -> Fault {
        Fault::missing(self.place, format!("{} lacks `{key}`", self.name))
            .label(format!("add `{key}`, {wanted}: {about}"))
    }
    fn unknown(&self, entry: &Entry, keys: &[Key], own: &[&str]) -> Fault {
        let known = || own.iter().copied().chain(keys.iter().map(|k| k.name));
        let fault = Fault::at(&entry.place, format!("unknown key `{}` in {}", shorten(&entry.key), self.name));
        let renamed = RENAMED.iter().find(|(old, new)| *old == entry.key && known().any(|key| key == *new));
        let fault = match (renamed, nearest(&entry.key, known())) {
            (Some((_, new)), _) => fault.label(format!("it is called `{new}`")),
            (None, Some(near)) => fault.label(format!("did you mean `{near}`?")),
            (None, None) => {
                let own = SECTIONS.iter().find(|section| self.name.starts_with(&section.header()));
                // Rather a section that is there once, and has it, than one of which some kind does.
                let home = SECTIONS.iter().find(|section| !section.many && section.has(&entry.key));
                let home = home.or_else(|| SECTIONS.iter().find(|section| section.knows(&entry.key)));
                // Another shape, say, may have the key.
                match home.filter(|_| !own.is_some_and(|own| own.knows(&entry.key))) {
                    Some(home) => fault.label(format!("it belongs in {}", home.header())),
                    None => fault,
                }
            }
        };
        fault.note(format!("known here: {}", listed(known())))
    }
    /// The one key of several that is given; exactly one must be.
    pub(super) fn one_of(&self, keys: &[&str], report: &mut Report) -> Option<&'a Entry> {
        let mut given = self.entries.iter().filter(|e| keys.contains(&e.key.as_str()));
        let Some(first) = given.next() else {
            report.push(Fault::missing(
                self.place,
                format!("{} needs one of {}", self.name, listed(keys.iter().copied())),
            ));
            return None;
        };
        let mut only = Some(first);
        for more in given {
            only = None;
            report.push(
                Fault::at(&more.place, format!("{} has both `{}` and `{}`", self.name, first.key, more.key))
                    .label("remove one of them"),
            );
        }
        only
    }
}

/// The sections of the scene, each with its name checked: `[name]` once, or `[[name]]` any number of times.
pub(super) fn sections<'a>(root: &'a [Entry], report: &mut Report) -> Vec<(&'static str, Table<'a>)> {
    let mut found = Vec::new();
    for entry in root {
        let Some(section) = SECTIONS.iter().find(|s| s.name == entry.key) else {
            report.push(unknown_section(entry));
            continue;
        };
        let mut add = |node: &'a Node, entries: &'a [Entry]| {
            found.push((section.name, Table { entries, place: &node.place, name: section.header() }));
        };
        match (&entry.node.data, section.many) {
            (Data::Table(entries), false) => add(&entry.node, entries),
            (Data::List(list), true) => {
                for node in list {
                    match &node.data {
                        Data::Table(entries) => add(node, entries),
                        _ => report.push(Fault::at(
                            &node.place,
                            format!("`{}` must be a list of tables, not of {}", section.name, node.describe(report)),
                        )),
                    }
                }
            }
            (Data::Table(_), true) => report.push(
                Fault::at(
                    &entry.node.place,
                    format!("there can be several [[{0}]], so it is written in double brackets", section.name),
                )
                .label(format!("write {}", section.header())),
            ),
            (Data::List(_), false) => report.push(
                Fault::at(
                    &entry.node.place,
                    format!("there is only one [{}], so it is written in single brackets", section.name),
                )
                .label(format!("write {}", section.header())),
            ),
            _ => report.push(
                Fault::at(
                    &entry.node.place,
                    format!("`{}` must be a section, not {}", section.name, entry.node.describe(report)),
                )
                .label(format!("write {} on a line of its own", section.header())),
            ),
        }
    }
    found
}

fn unknown_section(entry: &Entry) -> Fault {
    let name = shorten(&entry.key);
    let is_section = match &entry.node.data {
        Data::Table(_) => true,
        Data::List(list) => matches!(list.first(), Some(Node { data: Data::Table(_), .. })),
        _ => false,
    };
    let headers: Vec<_> = SECTIONS.iter().map(super::sections::Section::header).collect();
    if !is_section {
        let fault = Fault::at(&entry.place, format!("the key `{name}` is outside of every section"));
        let home = SECTIONS.iter().find(|s| s.knows(&entry.key));
        return match home {
            Some(home) => fault.label(format!("it belongs below {}", home.header())),
            None => fault.note(format!("the sections are {}", headers.join(", "))),
        };
    }
    let fault = Fault::at(&entry.place, format!("unknown section `{name}`"));
    let fault = match nearest(&entry.key, SECTIONS.iter().map(|s| s.name)) {
        Some(near) => {
            let header =
                SECTIONS.iter().find(|s| s.name == near).map_or_else(String::new, super::sections::Section::header);
            fault.label(format!("did you mean {header}?"))
        }
        None => fault,
    };
    fault.note(format!("the sections are {}", headers.join(", ")))
}

/// One of the names of a register; `noun` describes them.
pub(super) fn choice<'a>(entry: &Entry, noun: &str, known: &[&'a str], report: &mut Report) -> Option<&'a str> {
    value::choice(&entry.node, &entry.key, noun, known, report)
}

/// An integer from one to 2⁵³.
pub(super) fn whole_from_one(entry: &Entry, report: &mut Report) -> Option<u64> {
    let value = value::number(&entry.node, &entry.key, Kind::Whole, "a whole number, one or above", report)?;
    if value < 1.0 {
        report
            .push(Fault::at(&entry.node.place, format!("`{}` must be a whole number, one or above, not 0", entry.key)));
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, at least one, and below 2^53")]
    Some(value as u64)
}
