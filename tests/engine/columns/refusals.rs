//! What is refused, in words that name it.

use motes::forces::{Law, Over};
use motes::kernel::{Column, Columns, Kind, Machine, Source};

use super::{charged, problem};

fn refusal(law: Law) -> String {
    law.kernel(&problem(10, Machine::HOST)).expect_err("it is refused").to_string()
}

#[test]
fn a_column_that_is_not_declared() {
    let mut law = charged(Over::Pairs);
    law.into.push("heating".into());
    let text = refusal(law);
    assert!(text.contains("`charged` writes `heating`") && text.contains("[[column]]"), "{text}");
}

#[test]
fn a_column_that_is_promised_and_not_bound() {
    let mut law = charged(Over::Pairs);
    law.into.push("charge".into());
    let text = refusal(law);
    assert!(text.contains("binds no `var<storage, read_write> charge`"), "{text}");
}

#[test]
fn a_column_that_is_written_without_a_word() {
    let mut law = charged(Over::Pairs);
    law.into.retain(|name| name != "torque");
    let text = refusal(law);
    assert!(text.contains("`torque` as read_write") && text.contains("`into`"), "{text}");
}

#[test]
fn a_column_of_another_kind() {
    let wgsl = "@group(3) @binding(1) var<storage, read> charge: array<vec4f>;
        fn force(me: Particle) -> vec4f { return charge[me.index]; }";
    let law = Law::each("wide", Source::ours("wide", wgsl), Vec::new(), |_, _| glam::DVec4::ZERO);
    let text = refusal(law);
    assert!(text.contains("`charge` with elements of 16 bytes") && text.contains("array<f32>"), "{text}");
}

#[test]
fn declarations_that_contradict_each_other() {
    let scalar = || Column::new("charge", Kind::Scalar, "charge", "how strongly it pushes");
    let said = |columns: Vec<Column>| Columns::with(columns).err().map(|error| error.to_string()).unwrap_or_default();
    assert_eq!(said(vec![scalar(), scalar()]), "");
    let other = Column::new("charge", Kind::Vector, "charge", "which way");
    assert!(said(vec![scalar(), other]).contains("`charge` is declared twice"), "twice");
    assert!(said(vec![Column::new("2nd", Kind::Scalar, "", "")]).contains("`2nd`"), "a name");
    assert!(said(vec![Column::new("world", Kind::Scalar, "", "")]).contains("the engine"), "reserved");
    assert!(said(vec![scalar().with_rate("current")]).contains("`current`, which no component declares"), "a rate");
    let rate = Column::new("current", Kind::Vector, "charge / time", "");
    assert!(said(vec![scalar().with_rate("current"), rate]).contains("one kind and shape"), "a rate of another kind");
}
