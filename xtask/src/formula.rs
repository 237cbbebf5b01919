//! Formulas of pages: LaTeX to MathML, which browsers set by themselves.

use anyhow::{Context, Result};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

/// Whether a formula stands in a line or on its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Display {
    Inline,
    Block,
}

/// The MathML of a formula.
///
/// # Errors
/// When it is not LaTeX; the message holds the formula.
pub(crate) fn mathml(latex: &str, display: Display) -> Result<String> {
    let one_line = || latex.split_whitespace().collect::<Vec<_>>().join(" ");
    let storage = Storage::new();
    // The renderer writes errors into the page: they are found before.
    let events: Result<Vec<_>, _> = Parser::new(latex, &storage).collect();
    let events = events
        .map_err(|error| {
            let reason = error.to_string();
            let reason = reason.lines().next().unwrap_or("not LaTeX").to_owned();
            anyhow::anyhow!(reason)
        })
        .with_context(|| format!("the formula \"{}\"", one_line()))?;
    let config = RenderConfig {
        display_mode: match display {
            Display::Inline => DisplayMode::Inline,
            Display::Block => DisplayMode::Block,
        },
        ..RenderConfig::default()
    };
    let mut mathml = String::new();
    let events = events.into_iter().map(Ok::<_, std::fmt::Error>);
    push_mathml(&mut mathml, events, config).with_context(one_line)?;
    Ok(mathml)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_becomes_mathml() {
        let line = mathml(
            r"\mathbf{p}(t) = \mathbf{e} + t\,\mathbf{d}",
            Display::Inline,
        )
        .unwrap();
        assert!(line.starts_with("<math"), "{line}");
        assert!(line.contains("<mi>t</mi>"), "{line}");
        let block = mathml(r"t = \frac{-B \pm \sqrt{B^2 - 4AC}}{2A}", Display::Block).unwrap();
        assert!(
            block.contains("<mfrac>") && block.contains("<msqrt>"),
            "{block}"
        );
        assert!(block.contains("display=\"block\""), "{block}");
    }

    #[test]
    fn what_is_not_latex_is_refused_with_the_formula() {
        for latex in [r"\frac{1", r"\nosuchcommand", r"\begin{matrix} a"] {
            let error = mathml(latex, Display::Inline).unwrap_err();
            assert!(error.to_string().contains(latex), "{error:#}");
        }
    }
}
