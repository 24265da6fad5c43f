//! Colours by speed.

use glam::DVec3;
use rayon::prelude::*;

use super::frame::{COLOR, Frame, whole};
use super::palette::pack;
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads, VELOCITY};

const DARK_END: f64 = 0.3;
const BRIGHT_END: f64 = 0.93;

/// The kernel.
pub fn kernel(frame: &Frame) -> Result<Kernel, Error> {
    let pass = frame.pass(&[crate::shader!("render/paint.wgsl")], Threads::new(frame.count), 1)?;
    let (slow, fast) = frame.speeds;
    let twin = move |host: &Host| {
        let velocity = host.read(VELOCITY)?;
        host.write(COLOR)?.par_iter_mut().zip(&velocity[..]).for_each(|(color, v)| {
            let part = ((v.truncate().length() - slow) / (fast - slow)).clamp(0.0, 1.0);
            *color = rounded(inferno(DARK_END + (BRIGHT_END - DARK_END) * part));
        });
        Ok(())
    };
    Ok(frame.kernel("paint", vec![pass], std::sync::Arc::new(twin)))
}

fn rounded(rgb: DVec3) -> u32 {
    let byte = |x: f64| u8::try_from(whole((x.clamp(0.0, 1.0) * 255.0 + 0.5).floor())).unwrap_or(u8::MAX);
    pack([byte(rgb.x), byte(rgb.y), byte(rgb.z)])
}

/// The coefficients of `shaders/render/paint.wgsl`, the lowest power first.
const INFERNO: [DVec3; 7] = [
    DVec3::new(0.000_218_940_369_119_226_5, 0.001_651_004_631_001_012, -0.019_480_898_437_091_84),
    DVec3::new(0.106_513_419_485_611_6, 0.563_956_436_788_409_1, 3.932_712_388_889_277),
    DVec3::new(11.602_493_082_471_87, -3.972_853_965_665_698, -15.942_394_106_291_4),
    DVec3::new(-41.703_996_131_394_59, 17.436_398_882_053_13, 44.354_145_198_728_13),
    DVec3::new(77.162_935_699_427, -33.402_358_942_100_92, -81.807_309_257_389_93),
    DVec3::new(-71.319_428_244_992_14, 32.626_064_263_977_23, 73.209_519_858_032_02),
    DVec3::new(25.131_126_226_773_41, -12.242_668_952_385_67, -23.070_325_002_871_72),
];

fn inferno(t: f64) -> DVec3 {
    INFERNO.iter().rev().fold(DVec3::ZERO, |sum, c| sum * t + *c)
}
