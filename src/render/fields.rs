//! The fields of a picture, by their names in shaders.

use glam::Vec4;

use crate::kernel::Field;

pub const PROJECTED: Field<Vec4> = Field::new("projected");
pub const COLOR: Field<u32> = Field::new("color");
pub const TRAIL: Field<Vec4> = Field::new("trail");
pub const NOT_DRAWN: Field<u32> = Field::new("not_drawn");
pub const CANVAS: Field<u32> = Field::new("canvas");
pub const FRONT: Field<u32> = Field::new("front");
pub const OWNER: Field<u32> = Field::new("owner");
pub const STREAK: Field<u32> = Field::new("streak");
pub const HISTOGRAM: Field<u32> = Field::new("histogram");
pub const BLOOM: Field<Vec4> = Field::new("bloom");
pub const BLURRED: Field<Vec4> = Field::new("blurred");
pub const PIXELS: Field<u32> = Field::new("pixels");
pub const FACET: Field<u32> = Field::new("facet");
pub const SLOT: Field<u32> = Field::new("slot");
pub const BROKEN_FACET: Field<u32> = Field::new("broken_facet");
pub const AROUND_START: Field<u32> = Field::new("around_start");
pub const AROUND: Field<u32> = Field::new("around");
pub const HIDDEN: Field<u32> = Field::new("hidden");
pub const VERTEX: Field<Vec4> = Field::new("vertex");
pub const NEAREST: Field<u32> = Field::new("nearest");
pub const HOLDER: Field<u32> = Field::new("holder");
/// The same as the lamp sees them.
pub const LIT_VERTEX: Field<Vec4> = Field::new("lit_vertex");
pub const LIT: Field<u32> = Field::new("lit");
pub const SOLID: Field<u32> = Field::new("solid");
pub const SCENERY: Field<u32> = Field::new("scenery");
/// Of a fluid: the nearest front, how much there is along the line of sight, how much of a pixel it covers, and its particle.
pub const CREST: Field<u32> = Field::new("crest");
pub const VOLUME: Field<u32> = Field::new("volume");
pub const RIM: Field<u32> = Field::new("rim");
pub const SOURCE: Field<u32> = Field::new("source");
/// What walls in its plane cover, and both with the part that counts, three numbers for each pixel.
pub const WALL: Field<u32> = Field::new("wall");
pub const COVER: Field<f32> = Field::new("cover");
pub const NEXT_COVER: Field<f32> = Field::new("next_cover");
/// Its surface, and the same after the next pass.
pub const LEVEL: Field<f32> = Field::new("level");
pub const THICKNESS: Field<f32> = Field::new("thickness");
pub const DYE: Field<u32> = Field::new("dye");
pub const NEXT_LEVEL: Field<f32> = Field::new("next_level");
pub const NEXT_THICKNESS: Field<f32> = Field::new("next_thickness");
pub const NEXT_DYE: Field<u32> = Field::new("next_dye");
/// Background, scenery and fluid.
pub const WET: Field<u32> = Field::new("wet");
pub const EDGE: Field<Vec4> = Field::new("edge");

/// Fields that live as long as one picture is drawn.
pub const FIELDS: [&str; 40] = [
    PROJECTED.name,
    COLOR.name,
    TRAIL.name,
    NOT_DRAWN.name,
    CANVAS.name,
    FRONT.name,
    OWNER.name,
    STREAK.name,
    HISTOGRAM.name,
    BLOOM.name,
    BLURRED.name,
    PIXELS.name,
    FACET.name,
    SLOT.name,
    BROKEN_FACET.name,
    AROUND_START.name,
    AROUND.name,
    HIDDEN.name,
    VERTEX.name,
    NEAREST.name,
    HOLDER.name,
    LIT_VERTEX.name,
    LIT.name,
    SOLID.name,
    SCENERY.name,
    CREST.name,
    VOLUME.name,
    RIM.name,
    SOURCE.name,
    WALL.name,
    COVER.name,
    NEXT_COVER.name,
    LEVEL.name,
    THICKNESS.name,
    DYE.name,
    NEXT_LEVEL.name,
    NEXT_THICKNESS.name,
    NEXT_DYE.name,
    WET.name,
    EDGE.name,
];
