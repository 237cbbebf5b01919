//! What may be asked of a report.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::super::args::metres;

/// A report by a rule.
#[derive(Clone, Debug, Args)]
pub(crate) struct ReportArgs {
    /// The table that a rule asks for, instead of a map: -o OUT writes OUT.csv, OUT.json and OUT.html, or the one of them that OUT names
    #[arg(long, value_enum, value_name = "RULE", conflicts_with_all = ["png", "contours", "levels", "tiles", "max_zoom", "frames", "every", "glb", "spells", "attribute", "by_building", "area", "margin", "study", "on", "resume"])]
    pub(crate) report: Option<Rule>,

    /// What the rule protects: parks and gardens as polygons (GeoJSON), called by their attribute `name`; for japan the site
    #[arg(
        long,
        value_name = "FILE",
        requires = "report",
        conflicts_with = "points"
    )]
    pub(crate) resources: Option<PathBuf>,

    /// With --report japan: how high above the average ground shadow is measured [default: 4]
    #[arg(long, value_name = "METRES", requires = "report", value_parser = metres)]
    pub(crate) plane: Option<f64>,

    /// With --report japan: hours of shadow that are allowed beyond 5 m and beyond 10 m of the site [default: 4h,2.5h; with --hokkaido 3h,2h]
    #[arg(long, value_name = "H,H", requires = "report", value_parser = limits)]
    pub(crate) limits: Option<[f64; 2]>,

    /// With --report japan: hours are from 9 to 15, not from 8 to 16
    #[arg(long, requires = "report")]
    pub(crate) hokkaido: bool,
}

/// Whose rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Rule {
    /// New York: incremental shadow on four days, by the CEQR Technical Manual
    Ceqr,
    /// San Francisco: the shadow of a year on parks, by Planning Code section 295
    PropK,
    /// Britain and Europe: sun in gardens by BRE 209, at --points by EN 17037
    Bre,
    /// Japan: hours of shadow around a site at the winter solstice, by article 56-2 of the Building Standards Act
    Japan,
}

impl Rule {
    /// As it is typed.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Ceqr => "ceqr",
            Self::PropK => "prop-k",
            Self::Bre => "bre",
            Self::Japan => "japan",
        }
    }
}

/// Two lengths of time, in seconds: the longer one first.
fn limits(text: &str) -> Result<[f64; 2], String> {
    let hours = |text: &str| -> Option<f64> {
        let number = text.trim().trim_end_matches('h').trim_end();
        (number.parse().ok()).filter(|hours| (0.0..=8.0).contains(hours))
    };
    let both = text.split_once(',');
    let both = both.and_then(|(near, far)| Some([hours(near)?, hours(far)?]));
    match both {
        Some([near, far]) if near >= far => Ok([near, far].map(|hours| hours * 3600.0)),
        _ => Err("hours beyond 5 m and, no more of them, beyond 10 m are wanted, as 4h,2.5h, 5h,3h or 3h,2h".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_two_lengths_of_time() {
        assert_eq!(limits("4h,2.5h"), Ok([14_400.0, 9000.0]));
        assert_eq!(limits("3, 2 h"), Ok([10_800.0, 7200.0]));
        for wrong in ["", "4h", "2h,3h", "a,b", "9h,3h", "nan,1", "4h,2h,1h"] {
            assert!(limits(wrong).is_err(), "{wrong}");
        }
    }
}
