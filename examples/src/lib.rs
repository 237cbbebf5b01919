//! What the examples share, so that each of them holds nothing but its idea: drawing.

use std::io;
use std::path::PathBuf;

/// Draws numbers from 0 (blank) to 1 (full) as characters, a line a row.
#[must_use]
pub fn ascii(width: usize, shades: &[f32]) -> String {
    const INK: &[u8] = b" .:-=+*#%@";
    let character = |shade: &f32| {
        let step = shade.clamp(0.0, 1.0) * (INK.len() - 1) as f32;
        char::from(INK[step.round() as usize])
    };
    let rows = shades.chunks(width.max(1));
    rows.map(|row| row.iter().map(character).chain(['\n']).collect::<String>())
        .collect()
}

/// Writes a picture of colours from 0 to 1 as `out/NAME.ppm` and returns its path.
///
/// # Errors
/// When the file cannot be written.
pub fn write_ppm(name: &str, width: usize, colours: &[[f32; 3]]) -> io::Result<PathBuf> {
    let height = colours.len() / width.max(1);
    let mut bytes = format!("P6\n{width} {height}\n255\n").into_bytes();
    let byte = |component: f32| (component.clamp(0.0, 1.0) * 255.0).round() as u8;
    bytes.extend(colours.iter().flat_map(|colour| colour.map(byte)));
    std::fs::create_dir_all("out")?;
    let path = PathBuf::from(format!("out/{name}.ppm"));
    std::fs::write(&path, bytes)?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    #[test]
    fn shades_become_characters_line_by_line() {
        let drawn = super::ascii(2, &[0.0, 1.0, 0.5, f32::NAN]);
        assert_eq!(drawn, " @\n+ \n");
    }
}
