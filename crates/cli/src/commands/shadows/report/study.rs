//! What is studied: a city before and after a change, days and hours by a rule, areas and their places.

use anyhow::bail;
use ombra::accrual::{Again, Exact, Ground, Occluders, Tiles};
use ombra::city::{Building, Change, City, Edited, Extent, Inside};
use ombra::geometry::{Aabb, Point3};
use ombra::pipeline::Cpu;
use ombra::sun::{Place, Sheet, Span};
use serde_json::{Value, json};

use super::super::args::ShadowsArgs;
use super::super::places::{Asked, Places};
use super::super::reach::Reach;
use super::super::site::Site;
use super::super::when::{When, calendar};
use super::super::{Session, wrong_usage};
use super::args::Rule;
use super::frame::rounded;
use super::map::MapDrawing;
use super::progress::{Progress, blocks};
use super::resources::{self, Resource};
use super::{bre, ceqr, japan, prop_k};
use crate::commands::Talk;
use crate::progress::Jobs;

/// All that a report needs.
pub(super) struct Study<'a> {
    pub(super) args: &'a ShadowsArgs,
    session: &'a Session,
    pub(super) when: When,
    pub(super) before: City,
    /// `None` where nothing is to be changed.
    pub(super) edited: Option<Edited>,
    pub(super) resources: Vec<Resource>,
    /// Those of `--points`.
    pub(super) points: Option<Places>,
    /// How far the city reaches around the places, if it matters.
    pub(super) around: Option<Reach>,
}

impl<'a> Study<'a> {
    pub(super) fn read(
        args: &'a ShadowsArgs,
        rule: Rule,
        session: &'a Session,
        talk: &Talk,
    ) -> anyhow::Result<Self> {
        let cpu = &session.cpu;
        let mut site = cpu.install(|| Site::read(args))?;
        let edits = cpu.install(|| args.what_if.read(args, site.origin(), talk))?;
        let is_changed = args.what_if.is_asked();
        if is_changed {
            cpu.install(|| site.edit(&edits))?;
        }
        let place = Place::new(site.origin().latitude(), site.origin().longitude(), 0.0)?;
        let calendar = calendar(&args.when, &place)?;
        let when = match rule {
            Rule::Ceqr => ceqr::when(&args.when, &calendar),
            Rule::PropK => prop_k::when(&args.when, &calendar),
            Rule::Bre => bre::when(args, &calendar),
            Rule::Japan => japan::when(args, &calendar)?,
        };
        let when = cpu.install(|| When::new(&when, args.sun, place, None))?;
        if rule == Rule::Bre && when.days != 1 {
            wrong_usage("--report bre: one day is wanted, as --date 2026-03-21");
        }
        let all = cpu.install(|| site.extent());
        let asked = match &args.places.points {
            Some(_) => Some(Asked::read(&args.places, site.origin(), all, talk)?),
            None => None,
        };
        let areas = match &args.report.resources {
            Some(path) => resources::read(path, site.origin(), all, talk)?,
            None => Vec::new(),
        };
        if let (Rule::Japan, Some(path)) = (rule, &args.report.resources) {
            japan::check(&areas, path)?;
        }
        let mut extent = asked
            .as_ref()
            .map_or(Extent::NOWHERE, |asked| asked.extent(all));
        for area in &areas {
            let [low, high] = area.within.bounds();
            extent = extent.with(low).with(high);
        }
        let (lowest, surface) = (when.lowest_altitude(), site.surface());
        let (before, edited, _) = cpu.install(|| site.cities(extent, lowest))?;
        if is_changed && edited.is_none() {
            bail!(
                "{}: --with, --without and --height change the buildings of a city, and a surface model has none",
                args.city
            );
        }
        let after = edited.as_ref().map(|edited| &edited.city);
        let others = after.iter().flat_map(|after| &after.findings);
        let others = others.filter(|finding| !before.findings.contains(finding));
        for finding in before.findings.iter().chain(others) {
            talk.say(&format!("{}: {finding}", args.city));
        }
        let cell = args.places.cell;
        let after = after.unwrap_or(&before);
        let resource = |area| cpu.install(|| Resource::new(area, cell, &before, after));
        let resources: Vec<Resource> = areas.into_iter().map(resource).collect();
        let points = asked.map(|asked| Places::new(&args.places, asked, after, all, talk));
        let points = points.transpose()?;
        let tiles = points.iter().map(|points| &points.tiles);
        let tiles = tiles.chain(resources.iter().map(|resource| &resource.tiles));
        let ends = ends(tiles.flat_map(Tiles::places));
        // Of proposed buildings alone all is known.
        let ends = ends.filter(|_| rule != Rule::Japan);
        let reach = |ends: [Point3; 2]| {
            let tiles = Tiles::near(&ends);
            cpu.install(|| Reach::new(&before.facets(), surface, &tiles, &when))
        };
        Ok(Self {
            args,
            session,
            around: ends.map(reach),
            when,
            points,
            resources,
            edited,
            before,
        })
    }

    pub(super) fn cpu(&self) -> &Cpu {
        &self.session.cpu
    }

    /// The city with the change.
    pub(super) fn after(&self) -> &City {
        self.edited
            .as_ref()
            .map_or(&self.before, |edited| &edited.city)
    }

    pub(super) fn change(&self) -> Change {
        let edited = self.edited.as_ref();
        let edited = edited.expect("rules that ask for a change refuse to go without one");
        self.cpu().install(|| Change::between(&self.before, edited))
    }

    /// The way of the sun in some stretches of time.
    pub(super) fn sheets(&self, spans: &[Span]) -> Vec<Sheet> {
        let cover = |&span: &Span| Sheet::cover(&self.when.suns[0], span);
        self.cpu()
            .install(|| spans.iter().flat_map(cover).collect())
    }

    /// The places of a resource for which the change makes a difference.
    pub(super) fn again(
        &self,
        resource: &Resource,
        occluders: &Occluders,
        change: &Change,
        sheets: &[Sheet],
    ) -> Again {
        let (ground, inside) = (Ground::new(&self.before), Inside::new(&self.before));
        let was_free = |at| ground.at(at).is_some_and(|place| !inside.contains(place));
        let kept = |at| resource.area.within.contains(at) && was_free(at);
        self.cpu().install(|| {
            let fresh = Tiles::on_changed_ground(self.after(), &resource.grid, change, kept);
            Again::new(occluders, change, sheets, &resource.tiles, None, fresh)
        })
    }

    /// How many seconds each place of some tiles lies in shadow. `None` if it was interrupted.
    pub(super) fn seconds(
        &self,
        exact: &Exact<'_>,
        tiles: &Tiles,
        progress: &mut Progress<'_>,
    ) -> Option<Vec<f64>> {
        let mut seconds = Vec::with_capacity(tiles.places().len());
        for block in blocks(tiles) {
            let own = self.cpu().install(|| exact.seconds_of(tiles, block));
            progress.step(own.len())?;
            seconds.extend(own);
        }
        Some(seconds)
    }

    /// A bar for so many places.
    pub(super) fn progress(&self, total: usize) -> Progress<'_> {
        Progress {
            bar: Jobs::unless(self.args.quiet),
            done: 0,
            total: total as u64,
            stop: &self.session.stop,
        }
    }

    /// A map with what stands, what comes, what goes, and the areas, drawn over `under`.
    pub(super) fn map(&self, under: impl FnOnce(&mut MapDrawing)) -> MapDrawing {
        let corner = |at: [f32; 2]| at.map(f64::from);
        let around = self
            .new_buildings()
            .flat_map(|building| building.bounds().map(corner));
        let areas = self.resources.iter().map(|resource| &resource.area);
        let corners = areas.flat_map(|area| area.within.bounds());
        self.map_of(
            around.chain(corners).fold(Extent::NOWHERE, Extent::with),
            under,
        )
    }

    /// The buildings that come, or are no more as they were.
    pub(super) fn new_buildings(&self) -> impl Iterator<Item = &Building> {
        let edited = self.edited.iter();
        let all = edited.flat_map(|edited| edited.city.buildings.iter().zip(&edited.kept));
        all.filter(|own| own.1.is_none()).map(|own| own.0)
    }

    /// The same of an extent.
    pub(super) fn map_of(&self, extent: Extent, under: impl FnOnce(&mut MapDrawing)) -> MapDrawing {
        let kept = self.edited.as_ref().map(|edited| &edited.kept);
        let is_new = |number: usize| kept.is_some_and(|kept| kept[number].is_none());
        let buildings = self.after().buildings.iter().enumerate();
        let mut map = MapDrawing::new(extent);
        let old = buildings.filter(|(number, _)| !is_new(*number));
        map.buildings(old.map(|own| own.1), "class=\"stands\"");
        under(&mut map);
        map.buildings(self.new_buildings(), "class=\"new\"");
        let gone = self.before.buildings.iter().zip(0..);
        let is_gone = |number| kept.is_some_and(|kept| !kept.contains(&Some(number)));
        let gone = gone.filter(|own| is_gone(own.1)).map(|own| own.0);
        map.buildings(gone, "class=\"gone\"");
        map.areas(self.resources.iter().map(|resource| &resource.area));
        map
    }

    /// The areas and what stands for them, for programs; nothing for points.
    pub(super) fn resources_json(&self) -> Option<(String, Value)> {
        let resource = |resource: &Resource| {
            json!({
                "name": resource.area.name,
                "area_m2": rounded(resource.area.size, 2),
                "open_m2": rounded(resource.open(), 2),
                "cells": resource.cells,
                "in_buildings": resource.in_buildings,
                "built_over": resource.built_over,
                "places": resource.places(),
            })
        };
        let all: Vec<Value> = self.resources.iter().map(resource).collect();
        self.points
            .is_none()
            .then(|| ("resources".to_owned(), all.into()))
    }

    /// One number for each cell of a resource's grid, out of those for its places; NaN for the rest.
    pub(super) fn spread(resource: &Resource, values: impl IntoIterator<Item = f64>) -> Vec<f32> {
        let mut cells = vec![f32::NAN; resource.grid.count()];
        for (&index, value) in resource.tiles.indices().iter().zip(values) {
            cells[index as usize] = value as f32;
        }
        cells
    }
}

/// The lowest and the highest corner of the box around places.
fn ends<'p>(places: impl Iterator<Item = &'p Point3>) -> Option<[Point3; 2]> {
    let around = Aabb::around(places.copied());
    (!around.is_empty()).then_some([around.min, around.max])
}
