//! Columns in the elements of buffers: several may share one.

use glam::DVec4;

use super::{Array, Column, Columns, Kind};

impl Columns {
    /// An empty array of the element type of a buffer; `None` where no column lies there.
    #[must_use]
    pub fn element(&self, buffer: &str) -> Option<Array> {
        let first = self.of_buffer(buffer).next()?;
        let alone = self.of_buffer(buffer).nth(1).is_none();
        Some(match first.kind {
            Kind::Scalar if alone => Array::Float(Vec::new()),
            Kind::Whole if alone => Array::Uint(Vec::new()),
            _ => Array::Vec4(Vec::new()),
        })
    }
    /// The elements of a buffer, for `particles` particles: `values` gives those of a column, which otherwise has its initial value.
    #[must_use]
    pub fn packed<'a>(
        &self,
        buffer: &str,
        particles: usize,
        values: impl Fn(&Column) -> Option<&'a Array>,
    ) -> Option<Array> {
        let mut array = self.element(buffer)?;
        let of = |column: &Column| values(column).cloned().unwrap_or_else(|| column.array(particles));
        let Array::Vec4(elements) = &mut array else { return self.of_buffer(buffer).next().map(of) };
        elements.resize(self.len_of(buffer, particles)?, DVec4::ZERO);
        for column in self.of_buffer(buffer) {
            insert(elements, column, &of(column));
        }
        Some(array)
    }
    /// The values of a column, extracted from the elements of its buffer.
    #[must_use]
    pub fn unpacked(column: &Column, elements: &Array) -> Array {
        let Array::Vec4(elements) = elements else { return elements.clone() };
        let first = usize::from(column.place.component);
        match column.kind {
            Kind::Vector => Array::Vec3(elements.iter().map(|v| v.truncate()).collect()),
            Kind::Quaternion => Array::Vec4(elements.clone()),
            Kind::Scalar => Array::Float(elements.iter().map(|v| v[first]).collect()),
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of 24 bits")]
            Kind::Whole => Array::Uint(elements.iter().map(|v| v[first] as u32).collect()),
        }
    }
}

/// Writes the values of a column into elements of four numbers.
pub fn insert(elements: &mut [DVec4], column: &Column, values: &Array) {
    let first = usize::from(column.place.component);
    match values {
        Array::Vec3(list) => elements.iter_mut().zip(list).for_each(|(to, v)| *to = v.extend(to.w)),
        Array::Vec4(list) => elements.iter_mut().zip(list).for_each(|(to, v)| *to = *v),
        Array::Float(list) => elements.iter_mut().zip(list).for_each(|(to, x)| to[first] = *x),
        Array::Uint(list) => elements.iter_mut().zip(list).for_each(|(to, n)| to[first] = f64::from(*n)),
    }
}
