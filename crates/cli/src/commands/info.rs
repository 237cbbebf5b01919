//! `ombra info`: what a file holds.

use std::fmt::{Display, Write as _};
use std::io::{self, Write as _};
use std::process::ExitCode;

use anyhow::bail;
use ombra::formats::city::CityInfo;
use ombra::formats::elevation::ElevationInfo;
use ombra::formats::{FileInfo, GltfInfo, ImageInfo, ModelInfo, SceneInfo, inspect};

use crate::args::InfoArgs;

pub(crate) fn run(args: &InfoArgs) -> anyhow::Result<ExitCode> {
    if !args.file.exists()
        && let Some(scene) = args.file.to_str().and_then(ombra::builtin::find)
    {
        bail!(
            "{} is a built-in scene, not a file: {}",
            scene.name,
            scene.line
        );
    }
    let info = inspect(&args.file)?;
    let text = if args.json {
        serde_json::to_string_pretty(&info)? + "\n"
    } else {
        words(&info)?
    };
    io::stdout().write_all(text.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}

fn words(info: &FileInfo) -> anyhow::Result<String> {
    match info {
        FileInfo::Model(info) => model(info),
        FileInfo::Image(info) => image(info),
        FileInfo::Scene(info) => scene(info),
        FileInfo::Gltf(info) => gltf(info),
        FileInfo::City(info) => city(info),
        FileInfo::Elevation(info) => elevation(info),
        other => Ok(serde_json::to_string_pretty(other)? + "\n"),
    }
}

fn model(info: &ModelInfo) -> anyhow::Result<String> {
    let mut text = String::new();
    let yes_or_no = |has| if has { "yes" } else { "no" };
    writeln!(text, "format      {}", info.format.name())?;
    writeln!(text, "vertices    {}", info.vertices)?;
    writeln!(text, "triangles   {}", info.triangles)?;
    if info.degenerate_triangles > 0 {
        writeln!(
            text,
            "degenerate  {} triangles without area, left out",
            info.degenerate_triangles
        )?;
    }
    if let Some([min, max]) = info.bounds {
        writeln!(text, "bounds      {min:?} to {max:?}")?;
    }
    writeln!(text, "normals     {}", yes_or_no(info.normals))?;
    writeln!(text, "uvs         {}", yes_or_no(info.uvs))?;
    for material in &info.materials {
        let (name, kind, triangles) = (&material.name, material.kind, material.triangles);
        writeln!(text, "material    {name}: {kind}, {triangles} triangles")?;
    }
    notes(&mut text, &info.findings)?;
    Ok(text)
}

fn gltf(info: &GltfInfo) -> anyhow::Result<String> {
    let mut text = String::new();
    write!(text, "format      {} {}", info.format, info.version)?;
    match &info.generator {
        Some(generator) => writeln!(text, ", written by {}", generator.escape_debug())?,
        None => writeln!(text)?,
    }
    writeln!(text, "nodes       {}", info.nodes)?;
    writeln!(text, "meshes      {}", info.meshes)?;
    writeln!(text, "objects     {}", info.objects)?;
    writeln!(text, "vertices    {}", info.vertices)?;
    write!(text, "triangles   {}", info.triangles)?;
    if info.placed_triangles == info.triangles {
        writeln!(text)?;
    } else {
        writeln!(text, ", placed {}", info.placed_triangles)?;
    }
    if let Some([min, max]) = info.bounds {
        writeln!(text, "bounds      {min:?} to {max:?}")?;
    }
    writeln!(
        text,
        "textures    {} of {} images",
        info.textures, info.images
    )?;
    writeln!(text, "cameras     {}", info.cameras)?;
    writeln!(text, "lights      {}", info.lights)?;
    if info.animations + info.skins > 0 {
        writeln!(
            text,
            "animations  {}, skins {}",
            info.animations, info.skins
        )?;
    }
    for material in &info.materials {
        let (name, kind, triangles) = (&material.name, material.kind, material.triangles);
        writeln!(
            text,
            "material    {}: {kind}, {triangles} triangles",
            name.escape_debug()
        )?;
    }
    notes(&mut text, &info.findings)?;
    Ok(text)
}

fn image(info: &ImageInfo) -> anyhow::Result<String> {
    let mut text = String::new();
    writeln!(text, "format      {}", info.format)?;
    writeln!(text, "size        {}x{} pixels", info.width, info.height)?;
    writeln!(
        text,
        "channels    {} ({})",
        info.channels.join(", "),
        info.sample
    )?;
    for (name, value) in &info.attributes {
        writeln!(text, "attribute   {name}: {value}")?;
    }
    Ok(text)
}

fn scene(info: &SceneInfo) -> anyhow::Result<String> {
    let mut text = String::new();
    writeln!(text, "format      ombra scene")?;
    writeln!(text, "objects     {}", info.objects)?;
    writeln!(text, "primitives  {}", info.primitives)?;
    writeln!(text, "materials   {}", info.materials)?;
    writeln!(text, "lights      {}", info.lights)?;
    writeln!(
        text,
        "camera      {}",
        if info.camera {
            "in the file"
        } else {
            "made to fit"
        }
    )?;
    notes(&mut text, &info.findings)?;
    Ok(text)
}

fn city(info: &CityInfo) -> anyhow::Result<String> {
    let mut text = String::new();
    let [east, north] = info.extent;
    let [longitude, latitude] = info.origin;
    writeln!(text, "format      {}", info.format)?;
    writeln!(text, "buildings   {}", info.buildings)?;
    writeln!(text, "parts       {}", info.parts)?;
    writeln!(text, "terrain     {} triangles", info.terrain)?;
    writeln!(text, "facets      {}", info.facets)?;
    writeln!(text, "extent      {east:.1} m x {north:.1} m (east, north)")?;
    writeln!(text, "crs         {}", info.crs.escape_debug())?;
    writeln!(
        text,
        "origin      {longitude:.6}, {latitude:.6} (longitude, latitude)"
    )?;
    if let Some(heights) = &info.heights {
        let (min, median, max) = (heights.min, heights.median, heights.max);
        writeln!(
            text,
            "heights     {min:.1} m to {max:.1} m, median {median:.1} m"
        )?;
    }
    notes(&mut text, &info.findings)?;
    Ok(text)
}

fn elevation(info: &ElevationInfo) -> anyhow::Result<String> {
    let mut text = String::new();
    writeln!(text, "format      {}, heights", info.format)?;
    writeln!(text, "size        {}x{} pixels", info.width, info.height)?;
    writeln!(text, "numbers     {}", info.sample)?;
    writeln!(text, "packed      {}", info.compression)?;
    if info.more_images > 0 {
        writeln!(
            text,
            "besides     {} more images, not used",
            info.more_images
        )?;
    }
    if let Some(crs) = &info.crs {
        writeln!(text, "crs         {}", crs.escape_debug())?;
    }
    if let Some([wide, high]) = info.pixel {
        writeln!(text, "pixel       {wide:.3} m x {high:.3} m")?;
    }
    if let Some([east, north]) = info.extent {
        writeln!(text, "extent      {east:.1} m x {north:.1} m (east, north)")?;
    }
    if let Some([longitude, latitude]) = info.origin {
        writeln!(
            text,
            "origin      {longitude:.6}, {latitude:.6} (longitude, latitude)"
        )?;
    }
    if let Some([low, high]) = info.heights {
        writeln!(text, "heights     {low:.2} m to {high:.2} m")?;
    }
    if let Some(blank) = info.blank {
        writeln!(text, "blank       {blank} pixels without a height")?;
    }
    notes(&mut text, &info.findings)?;
    Ok(text)
}

fn notes(text: &mut String, findings: &[impl Display]) -> anyhow::Result<()> {
    for finding in findings {
        writeln!(text, "note        {finding}")?;
    }
    Ok(())
}
