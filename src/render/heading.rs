//! Colours by heading.

use glam::{DVec3, DVec4};

const LIGHTNESS: f64 = 0.74;
const CLIMB: f64 = 0.13;
const CHROMA: f64 = 0.12;
const SLOWEST: f64 = 1e-30;

/// The colour of a velocity, in sRGB.
pub fn tint(v: DVec4) -> DVec3 {
    let u = if v.is_finite() { heading(v.truncate()) } else { DVec3::ZERO };
    srgb(DVec3::new(LIGHTNESS + CLIMB * u.z, CHROMA * u.x, CHROMA * u.y))
}

fn heading(v: DVec3) -> DVec3 {
    let w = v / v.abs().max_element().max(SLOWEST);
    w / w.length().max(1.0)
}

/// From Oklab.
fn srgb(lab: DVec3) -> DVec3 {
    let root = [
        DVec3::new(1.0, 0.396_337_777_4, 0.215_803_757_3),
        DVec3::new(1.0, -0.105_561_345_8, -0.063_854_172_8),
        DVec3::new(1.0, -0.089_484_177_5, -1.291_485_548_0),
    ];
    let linear = [
        DVec3::new(4.076_741_662_1, -3.307_711_591_3, 0.230_969_929_2),
        DVec3::new(-1.268_438_004_6, 2.609_757_401_1, -0.341_319_396_5),
        DVec3::new(-0.004_196_086_3, -0.703_418_614_7, 1.707_614_701_0),
    ];
    let lms = DVec3::from_array(root.map(|row| row.dot(lab).powi(3)));
    DVec3::from_array(linear.map(|row| 1.055 * row.dot(lms).powf(1.0 / 2.4) - 0.055))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Back to Oklab, by the inverse matrices of Ottosson 2020.
    fn oklab(srgb: DVec3) -> DVec3 {
        let linear = DVec3::from_array(srgb.to_array().map(|x| ((x + 0.055) / 1.055).powf(2.4)));
        let cones = [
            DVec3::new(0.4122214708, 0.5363325363, 0.0514459929),
            DVec3::new(0.2119034982, 0.6806995451, 0.1073969566),
            DVec3::new(0.0883024619, 0.2817188376, 0.6299787005),
        ];
        let root = DVec3::from_array(cones.map(|row| row.dot(linear).cbrt()));
        let lab = [
            DVec3::new(0.2104542553, 0.7936177850, -0.0040720468),
            DVec3::new(1.9779984951, -2.4285922050, 0.4505937099),
            DVec3::new(0.0259040371, 0.7827717662, -0.8086757660),
        ];
        DVec3::from_array(lab.map(|row| row.dot(root)))
    }
    fn flat(angle: f64) -> DVec4 {
        DVec4::new(angle.cos(), angle.sin(), 0.0, 0.3) * 7.3
    }

    #[test]
    fn in_the_plane_the_hue_is_the_angle_without_a_seam() {
        for degree in 0..360 {
            let angle = f64::from(degree).to_radians();
            let lab = oklab(tint(flat(angle)));
            // The published matrices are inverse to one another to eight digits.
            assert!(
                (lab - DVec3::new(LIGHTNESS, CHROMA * angle.cos(), CHROMA * angle.sin())).length() < 1e-6,
                "{degree}"
            );
            // A degree is a step of π C / 180 in Oklab, all the way round, and of a few levels of sRGB at most.
            let step = (tint(flat(angle)) - tint(flat(angle + 1f64.to_radians()))).abs().max_element();
            assert!(step < 2.5 / 255.0, "{degree}: {step}");
        }
    }
    #[test]
    fn climbing_is_light_diving_is_dark_and_rest_is_grey() {
        let lightness = |z: f64| oklab(tint(DVec4::new(0.3, -0.2, z, 0.0))).x;
        assert!(lightness(3.0) > lightness(0.1) + 0.05 && lightness(-3.0) < lightness(-0.1) - 0.05);
        let grey = tint(DVec4::new(0.0, 0.0, 0.0, 2.0));
        assert!((grey.max_element() - grey.min_element()) < 1e-3 && (oklab(grey).x - LIGHTNESS).abs() < 1e-6);
        for v in [DVec4::NAN, DVec4::new(f64::INFINITY, 0.0, 1.0, 0.0), DVec4::new(1e-42, 0.0, 0.0, 0.0)] {
            assert!((tint(v) - grey).length() < 1e-6, "{v}");
        }
        assert!((tint(DVec4::new(3e38, 3e38, 0.0, 0.0)) - tint(DVec4::new(1e-20, 1e-20, 0.0, 0.0))).length() < 1e-12);
    }
    #[test]
    fn every_heading_has_a_color_of_its_own() {
        // Only blue passes white a little, by less than what an eye tells apart: 0.02 of sRGB.
        for (azimuth, climb) in (0..360).step_by(5).flat_map(|a| (-90..=90).step_by(5).map(move |c| (a, c))) {
            let (azimuth, climb) = (f64::from(azimuth).to_radians(), f64::from(climb).to_radians());
            let v = DVec3::new(azimuth.cos() * climb.cos(), azimuth.sin() * climb.cos(), climb.sin());
            let c = tint(v.extend(0.0));
            assert!(c.min_element() > 0.0 && c.max_element() < 1.02, "{v}: {c}");
        }
    }
}
