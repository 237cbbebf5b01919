//! Numbered pictures in a folder.

use std::fs;
use std::io;
use std::path::Path;

use serde_json::{Value, json};

use crate::error::FormatError;
use crate::image::{ImageBuffer, Metadata, write_error, write_image};
use crate::whole_folder::{Kind, WholeFolder};

const KIND: Kind = Kind {
    what: "frames",
    marker: "frames.json",
    is_own: |name| {
        let number = name.strip_suffix(".png");
        number.is_some_and(|number| number.parse::<u32>().is_ok())
    },
};

#[derive(Debug)]
pub(super) struct Folder {
    folder: WholeFolder,
    list: Vec<Value>,
}

impl Folder {
    pub(super) fn create(path: &Path) -> Result<Self, FormatError> {
        Ok(Self {
            folder: WholeFolder::create(path, KIND)?,
            list: Vec::new(),
        })
    }

    pub(super) fn add(&mut self, picture: &ImageBuffer, name: &str) -> Result<(), FormatError> {
        let file = format!("{:04}.png", self.list.len());
        write_image(
            self.folder.path().join(&file),
            picture,
            &Metadata::default(),
        )?;
        self.list.push(json!({ "file": file, "shows": name }));
        Ok(())
    }

    pub(super) fn finish(self, metadata: &Metadata) -> Result<(), FormatError> {
        let mut about = json!({
            "generator": concat!("ombra ", env!("CARGO_PKG_VERSION")),
            "frames": self.list,
        });
        for (name, value) in metadata.entries() {
            about[name] = json!(value);
        }
        let text = serde_json::to_vec_pretty(&about)
            .map_err(io::Error::from)
            .map_err(write_error)?;
        fs::write(self.folder.path().join(KIND.marker), text).map_err(write_error)?;
        self.folder.finish()
    }
}
