//! `ombra shadows`, of a city or of what was found before.

use clap::{ArgMatches, Args, Command, Error, FromArgMatches};

use super::args::ShadowsArgs;
use super::spells::query::QueryArgs;

/// The name of the only word that is no city.
const QUERY: &str = "query";

/// What `ombra shadows` is to do. A city comes without a command of its own, and its arguments are required only then: clap cannot
/// derive that.
#[derive(Clone, Debug)]
pub(crate) enum ShadowsCommand {
    City(Box<ShadowsArgs>),
    Query(Box<QueryArgs>),
}

impl FromArgMatches for ShadowsCommand {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        match matches.subcommand() {
            Some((_, matches)) => {
                QueryArgs::from_arg_matches(matches).map(|args| Self::Query(Box::new(args)))
            }
            None => ShadowsArgs::from_arg_matches(matches).map(|args| Self::City(Box::new(args))),
        }
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for ShadowsCommand {
    fn augment_args(command: Command) -> Command {
        ShadowsArgs::augment_args(command)
            .subcommand(QueryArgs::augment_args(Command::new(QUERY)))
            .args_conflicts_with_subcommands(true)
            .subcommand_negates_reqs(true)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}
