//! From the materials of a document to Whitted's.

use ombra_scene::{Cutout, Material, PictureTexture, Rgb, Texture};

use super::notes::Notes;
use super::phong::phong;
use super::surface::{AlphaMode, MaterialSpec, TextureUse, Volume};
use super::texture::Textures;
use super::wrong;
use crate::error::FormatError;

/// A material, and which set of texture coordinates it is laid out by.
pub(super) struct Surface {
    pub(super) material: Material,
    pub(super) set: u32,
    /// Whether all of it is a hole.
    pub(super) hidden: bool,
}

/// Opacity below this is a hole, where it comes from a picture and is blended: what is left is as
/// opaque as its mean.
const CLEAR: f32 = 0.02;

/// Roughness and metal, colour and opacity, once the textures are looked at.
struct Base {
    factor: Rgb,
    picture: Option<PictureTexture>,
    alpha: f32,
    metal: f32,
    roughness: f32,
}

/// What a document without materials gives its meshes.
pub(super) fn default_surface() -> Surface {
    let spec = MaterialSpec::default();
    let base = Base {
        factor: Rgb::WHITE,
        picture: None,
        alpha: 1.0,
        metal: 1.0,
        roughness: 1.0,
    };
    let mut material = lit(&base, 0.0, 1.5);
    material.one_sided = !spec.double_sided;
    Surface {
        material,
        set: 0,
        hidden: false,
    }
}

pub(super) fn surface(
    spec: &MaterialSpec,
    place: &str,
    textures: &mut Textures<'_>,
    notes: &mut Notes,
) -> Result<Surface, FormatError> {
    let set = set(spec);
    let base = base(spec, place, textures, notes)?;
    let extensions = &spec.extensions;
    let ior = match &extensions.ior {
        None => 1.5,
        // 0 stands for what mirrors all there is.
        Some(ior) if ior.ior == 0.0 => f32::MAX.sqrt(),
        Some(ior) if ior.ior >= 1.0 && ior.ior.is_finite() => ior.ior,
        Some(ior) => {
            let message = format!("is {}; 1 or more, or 0, is right", ior.ior);
            return Err(wrong(
                format!("{place}.extensions.KHR_materials_ior.ior"),
                message,
            ));
        }
    };
    let transmission = transmission(spec, place, textures, notes)? * (1.0 - base.metal);
    let mut material = lit(&base, transmission, ior);
    material.one_sided = !spec.double_sided;
    if extensions.unlit.is_some() {
        material = unlit(&base, material);
    } else {
        emission(spec, set, place, textures, notes, &mut material)?;
    }
    if transmission > 0.0 {
        glass(spec, &base, transmission, ior, place, notes, &mut material)?;
    }
    let mut hidden = false;
    match spec.alpha_mode {
        AlphaMode::Opaque => {}
        AlphaMode::Mask => hidden = mask(spec, &base, place, &mut material)?,
        AlphaMode::Blend => blend(&base, place, notes, &mut material),
    }
    for (what, texture) in [
        ("normalTexture is", &spec.normal_texture),
        ("occlusionTexture is", &spec.occlusion_texture),
    ] {
        if texture.is_some() {
            notes.add(place, format!("{what} not used"));
        }
    }
    material.name = spec.name.clone().unwrap_or_else(|| place.to_owned());
    Ok(Surface {
        material,
        set,
        hidden,
    })
}

/// Which set of texture coordinates the material is laid out by: that of its base colour, else that
/// of its own light.
fn set(spec: &MaterialSpec) -> u32 {
    let base = spec.pbr_metallic_roughness.base_color_texture.as_ref();
    let texture = base.or(spec.emissive_texture.as_ref());
    texture.map_or(0, TextureUse::set)
}

fn base(
    spec: &MaterialSpec,
    place: &str,
    textures: &mut Textures<'_>,
    notes: &mut Notes,
) -> Result<Base, FormatError> {
    let pbr = &spec.pbr_metallic_roughness;
    let at = |name: &str| format!("{place}.pbrMetallicRoughness.{name}");
    let [r, g, b, alpha] = pbr.base_color_factor;
    let factor = colour([r, g, b], &at("baseColorFactor"))?;
    let alpha = share(alpha, &at("baseColorFactor[3]"))?;
    let mut metal = share(pbr.metallic_factor, &at("metallicFactor"))?;
    let mut roughness = share(pbr.roughness_factor, &at("roughnessFactor"))?;
    if let Some(texture) = &pbr.metallic_roughness_texture
        && let Some([_, g, b]) = textures.mean(texture, &at("metallicRoughnessTexture"), notes)?
    {
        notes.add(place, "of metallicRoughnessTexture the mean is used");
        roughness *= g;
        metal *= b;
    }
    let picture = match &pbr.base_color_texture {
        None => None,
        Some(texture) => {
            let with_alpha = spec.alpha_mode != AlphaMode::Opaque;
            textures.picture(texture, with_alpha, &at("baseColorTexture"), notes)?
        }
    };
    Ok(Base {
        factor,
        picture,
        alpha,
        metal,
        roughness,
    })
}

/// What light does to the surface, but for what goes through it.
fn lit(base: &Base, transmission: f32, ior: f32) -> Material {
    let mean = match &base.picture {
        Some(picture) => picture.average() * base.factor,
        None => base.factor,
    };
    let phong = phong(mean, base.metal, base.roughness, ior);
    Material {
        diffuse: coloured(base, phong.matt * (1.0 - transmission)),
        specular: phong.specular,
        shininess: phong.shininess,
        reflection: mean * phong.mirror,
        ..Material::default()
    }
}

/// A share of the base colour.
fn coloured(base: &Base, share: f32) -> Texture {
    match &base.picture {
        Some(picture) if share > 0.0 => Texture::Picture(PictureTexture {
            factor: base.factor * share,
            ..picture.clone()
        }),
        _ => Texture::Constant(base.factor * share),
    }
}

/// `KHR_materials_unlit`: the base colour as it is, whatever the light.
fn unlit(base: &Base, lit: Material) -> Material {
    Material {
        diffuse: Texture::Constant(Rgb::BLACK),
        emission: base.factor,
        emission_picture: base.picture.clone(),
        one_sided: lit.one_sided,
        ..Material::default()
    }
}

fn emission(
    spec: &MaterialSpec,
    set: u32,
    place: &str,
    textures: &mut Textures<'_>,
    notes: &mut Notes,
    material: &mut Material,
) -> Result<(), FormatError> {
    let strength = match &spec.extensions.emissive_strength {
        None => 1.0,
        Some(extension) => {
            let at = format!("{place}.extensions.KHR_materials_emissive_strength");
            not_negative(
                extension.emissive_strength,
                &format!("{at}.emissiveStrength"),
            )?
        }
    };
    let factor = colour(spec.emissive_factor, &format!("{place}.emissiveFactor"))?;
    material.emission = factor * strength;
    if !material.emission.to_array().iter().all(|c| c.is_finite()) {
        let message = format!(
            "is {:?}, which times the emissiveStrength {strength} is more than a number holds",
            spec.emissive_factor
        );
        return Err(wrong(format!("{place}.emissiveFactor"), message));
    }
    let Some(texture) = &spec.emissive_texture else {
        return Ok(());
    };
    if material.emission.is_black() {
        return Ok(());
    }
    let picture = textures.picture(texture, false, &format!("{place}.emissiveTexture"), notes)?;
    let Some(picture) = picture else {
        return Ok(());
    };
    if texture.set() == set {
        material.emission_picture = Some(picture);
    } else {
        notes.add(
            place,
            "emissiveTexture has other texture coordinates than the base colour: its mean is used",
        );
        material.emission *= picture.average();
    }
    Ok(())
}

/// How much goes through, 0 to 1.
fn transmission(
    spec: &MaterialSpec,
    place: &str,
    textures: &mut Textures<'_>,
    notes: &mut Notes,
) -> Result<f32, FormatError> {
    let Some(extension) = &spec.extensions.transmission else {
        return Ok(0.0);
    };
    let place = format!("{place}.extensions.KHR_materials_transmission");
    let factor = share(
        extension.transmission_factor,
        &format!("{place}.transmissionFactor"),
    )?;
    let Some(texture) = &extension.transmission_texture else {
        return Ok(factor);
    };
    if factor == 0.0 {
        return Ok(0.0);
    }
    let at = format!("{place}.transmissionTexture");
    let mean = textures.mean(texture, &at, notes)?;
    if mean.is_some() {
        notes.add(place, "of transmissionTexture the mean is used");
    }
    Ok(factor * mean.map_or(1.0, |[r, ..]| r))
}

/// What goes through, tinted by the base colour. With a volume behind it, it is a surface of glass
/// that bends and absorbs light; without, a thin sheet.
fn glass(
    spec: &MaterialSpec,
    base: &Base,
    transmission: f32,
    ior: f32,
    place: &str,
    notes: &mut Notes,
    material: &mut Material,
) -> Result<(), FormatError> {
    let tint = match &base.picture {
        Some(picture) => picture.average() * base.factor,
        None => base.factor,
    };
    material.transmission = tint * transmission;
    if base.roughness > 0.0 {
        notes.add(place, "rough glass is shown clear");
    }
    let volume = spec.extensions.volume.as_ref();
    if let Some(volume) = volume.filter(|volume| volume.thickness_factor > 0.0) {
        material.index_of_refraction = ior.max(1.0);
        material.fresnel = true;
        material.absorption = absorption(volume, place)?;
        // Light that went in has to come out again, through the back of the surface.
        material.one_sided = false;
    }
    Ok(())
}

/// Beer's law: what is left of white light after the attenuation distance is the attenuation colour.
fn absorption(volume: &Volume, place: &str) -> Result<Rgb, FormatError> {
    /// A component of 0 would take an infinite one.
    const DARKEST: f32 = 1e-4;
    let at = |name| format!("{place}.extensions.KHR_materials_volume.{name}");
    let Some(distance) = volume.attenuation_distance else {
        return Ok(Rgb::BLACK);
    };
    if !(distance > 0.0) {
        let message = format!("is {distance}; a number above 0 is right");
        return Err(wrong(at("attenuationDistance"), message));
    }
    let left = colour(volume.attenuation_color, &at("attenuationColor"))?;
    let lost = left
        .to_array()
        .map(|c| -c.clamp(DARKEST, 1.0).ln() / distance);
    Ok(lost
        .map(|x| if x.is_finite() { x.abs() } else { 0.0 })
        .into())
}

/// Opacity below the cutoff is a hole; whether all of the surface is one.
fn mask(
    spec: &MaterialSpec,
    base: &Base,
    place: &str,
    material: &mut Material,
) -> Result<bool, FormatError> {
    let cutoff = spec.alpha_cutoff.unwrap_or(0.5);
    let cutoff = not_negative(cutoff, &format!("{place}.alphaCutoff"))?;
    let with_alpha = |picture: &&PictureTexture| picture.image.alpha().is_some();
    let Some(picture) = base.picture.as_ref().filter(with_alpha) else {
        return Ok(base.alpha < cutoff);
    };
    // The opacity is the picture's times the factor, which goes to the other side of the comparison.
    if cutoff > 0.0 {
        material.cutout = Some(Cutout {
            picture: picture.clone(),
            cutoff: cutoff / base.alpha,
        });
    }
    Ok(base.alpha == 0.0 && cutoff > 0.0)
}

/// Opacity lets light through unbent. One number holds for the whole surface: where a picture gives
/// the opacity, what is clear is a hole, and the rest is as opaque as its mean.
fn blend(base: &Base, place: &str, notes: &mut Notes, material: &mut Material) {
    let mut opacity = base.alpha;
    if let Some(picture) = &base.picture
        && let Some(alpha) = picture.image.alpha()
    {
        let (mut sum, mut count) = (0.0_f64, 0_u64);
        for &a in alpha.iter().filter(|&&a| a >= CLEAR) {
            sum += f64::from(a);
            count += 1;
        }
        if (count as usize) < alpha.len() {
            let (picture, cutoff) = (picture.clone(), CLEAR);
            material.cutout = Some(Cutout { picture, cutoff });
        }
        let mean = if count > 0 { sum / count as f64 } else { 0.0 };
        if mean < 0.99 {
            notes.add(
                place,
                "of the opacity of its picture the mean is used (alphaMode BLEND)",
            );
            opacity *= mean as f32;
        }
    }
    if opacity >= 0.99 {
        return;
    }
    material.diffuse = match std::mem::replace(&mut material.diffuse, Rgb::BLACK.into()) {
        Texture::Picture(picture) => Texture::Picture(PictureTexture {
            factor: picture.factor * opacity,
            ..picture
        }),
        other => Texture::Constant(other.average() * opacity),
    };
    material.specular = material.specular * opacity;
    material.reflection = material.reflection * opacity;
    material.emission = material.emission * opacity;
    // What bends light cannot let other light through straight: glass stays what it is.
    if material.transmission.is_black() {
        material.transmission = Rgb::grey(1.0 - opacity);
    }
}

fn colour(components: [f32; 3], place: &str) -> Result<Rgb, FormatError> {
    if components.iter().all(|c| (0.0..=f32::MAX).contains(c)) {
        Ok(components.into())
    } else {
        let message = format!("is {components:?}; finite numbers of 0 or more are right");
        Err(wrong(place, message))
    }
}

/// A number from 0 to 1; one a little off is taken to the nearest.
fn share(number: f32, place: &str) -> Result<f32, FormatError> {
    if number.is_finite() {
        Ok(number.clamp(0.0, 1.0))
    } else {
        Err(wrong(place, format!("is {number}; 0 to 1 is right")))
    }
}

fn not_negative(number: f32, place: &str) -> Result<f32, FormatError> {
    if (0.0..=f32::MAX).contains(&number) {
        Ok(number)
    } else {
        Err(wrong(
            place,
            format!("is {number}; a finite number of 0 or more is right"),
        ))
    }
}
