//! PLY and VTP of other programs.

use glam::DVec3;
use hdf5_pure::FileBuilder;
use motes::formats;

use super::register::refused_as;
use super::{folder, put};

#[test]
fn ply_of_other_programs_is_read() {
    let folder = folder();
    let text = "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\n\
                element vertex 2\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\nproperty uchar red\r\nend_header\r\n\
                3 0 1 0\r\n1 2 3 255\r\n-4 5e-1 6 0\r\n";
    let state = super::read(&put(&folder, "a.ply", text)).expect("text");
    assert_eq!(state.position(), [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-4.0, 0.5, 6.0)]);
    let mut big =
        b"ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty double x\nproperty short y\nproperty float z\n\
                    property list uchar float w\nend_header\n"
            .to_vec();
    big.extend(0.1_f64.to_be_bytes());
    big.extend((-7_i16).to_be_bytes());
    big.extend(2.5_f32.to_be_bytes());
    let list = [&big[..], &[1], &[0; 4]].concat();
    let listed = put(&folder, "l.ply", list);
    assert_eq!(super::read(&listed).expect("a list is passed over").position(), [DVec3::new(0.1, -7.0, 2.5)]);
    assert_eq!(formats::contents(&listed).expect("a header").left_out, ["the list `w` of vertices"]);
    refused_as("s.ply", format!("{text}1 2 3 255\r\n"), "lines follow what the header announces");
    let text = String::from_utf8_lossy(&big[..big.len() - 14]).replace("property list uchar float w\n", "");
    let bytes = [text.as_bytes(), &big[big.len() - 14..]].concat();
    let state = super::read(&put(&folder, "b.ply", bytes)).expect("big-endian");
    assert_eq!(state.position(), [DVec3::new(0.1, -7.0, 2.5)]);
}

#[test]
fn vtp_of_other_programs_is_read() {
    let folder = folder();
    let file = |points: &str, more: &str| {
        format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData><FieldData>\
             <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\"> 2.5 </DataArray></FieldData>\n\
             <Piece NumberOfPoints=\"2\" NumberOfVerts=\"0\"><PointData>{more}</PointData><Points>{points}</Points></Piece></PolyData></VTKFile>"
        )
    };
    let text = "<DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n1 2 3\n-4 0.5 6\n</DataArray>";
    let more = "<DataArray type='Float32' Name='mass' format='ascii'>2 3</DataArray><DataArray type='String' Name='s'>a b</DataArray>";
    let state = super::read(&put(&folder, "a.vtp", file(text, more))).expect("text");
    assert_eq!(state.position(), [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-4.0, 0.5, 6.0)]);
    assert_eq!((state.mass(), state.time), (&[2.0, 3.0][..], 2.5));
    // 24 as a count of 32 bits, then 1 2 3 -4 0.5 6.
    let encoded = "<DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" format=\"binary\">\n\
                   GAAAAAAAgD8AAABAAABAQAAAgMAAAAA/AADAQA==\n</DataArray>";
    let state = super::read(&put(&folder, "b.vtp", file(encoded, ""))).expect("base 64");
    assert_eq!(state.position(), [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-4.0, 0.5, 6.0)]);
    refused_as("c.vtp", file(&text.replace(" 6", ""), ""), "`Points` has 5 numbers of 6");
    let packed = file(text, "").replace("version=\"0.1\"", "version=\"0.1\" compressor=\"vtkZLibDataCompressor\"");
    refused_as("d.vtp", packed.replace("ZLib", "LZ4"), "save it with zlib or without compression");
    refused_as("e.vtp", "<VTKFile type=\"PolyData\" ", "byte 0: a tag does not end");
    refused_as("f.vtp", "<VTKFile type=\"ImageData\"></VTKFile>", "is no VTK file of polygons");
}

/// Positions of one number each would be read beyond their end.
#[test]
fn positions_have_three_numbers() {
    let mut file = FileBuilder::new();
    let header = file.create_group("Header").finish();
    file.add_group(header);
    let mut group = file.create_group("PartType1");
    group.create_dataset("Coordinates").with_f64_data(&[1.0, 2.0]).with_shape(&[2]);
    file.add_group(group.finish());
    refused_as("a.hdf5", file.finish().expect("a file"), "Coordinates does not hold three numbers for each particle");
    let one = "<DataArray type=\"Float64\" NumberOfComponents=\"1\" format=\"binary\">EAAAAAAAAAAAAPA/AAAAAAAAAEA=</DataArray>";
    let file = format!(
        "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"2\"><Points>{one}</Points>\
         </Piece></PolyData></VTKFile>"
    );
    refused_as("a.vtp", file, "`position` has 1 components, and 3 are read");
}
