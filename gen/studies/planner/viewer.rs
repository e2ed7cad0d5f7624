//! The viewer: a page with the bodies of a scene, the contacts of every pose, and what was answered about each.

use super::Front;
use super::mark::Mark;
use super::outcome::{Contact, Counted, Row};
use super::segment::segment;
use super::undecided::reason;
use askama::Template;
use efsat_geometry::scene::{Frame, Pose};
use efsat_unit::golden::{Golden, Margin, Reason};
use efsat_unit::host::{Host, ReadyMeeting, ReadyScene, ScenePose};
use efsat_unit::pair::{Outcome, Verdict};
use efsat_unit::params::{Method, Params};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Template)]
#[template(path = "viewer.html")]
struct Page<'a> {
    scene: &'a str,
    command: &'a str,
    shown: usize,
    poses: usize,
    style: &'static str,
    library: String,
    script: &'static str,
    data: String,
    version: &'static str,
}

/// What the script reads.
#[derive(Serialize)]
struct Data<'a> {
    meshes: Vec<Mesh>,
    objects: Vec<Object<'a>>,
    frames: &'a [Shown],
    /// The frame that is shown first, by its place in the list.
    first: usize,
    kinds: [Kind; 4],
    /// What a witness is, what each is called, and what its sign means.
    witness: &'static str,
    witnesses: &'a [String],
    words: BTreeMap<char, &'static str>,
    /// What is said of a pair without witnesses.
    silent: &'static str,
}

#[derive(Serialize)]
struct Mesh {
    vertices: Vec<f32>,
    faces: Vec<u32>,
}

#[derive(Serialize)]
struct Object<'a> {
    name: &'a str,
    mesh: usize,
    /// What its triangles are called; empty if by their numbers in the mesh.
    triangles: Vec<String>,
}

#[derive(Serialize)]
struct Kind {
    words: &'static str,
    verdict: &'static str,
    colour: String,
}

#[derive(Serialize)]
struct Shown {
    number: usize,
    label: String,
    summary: String,
    /// Rows of the matrix, then the translation, of every object.
    poses: Vec<[f64; 12]>,
    contacts: Vec<Pair>,
}

/// Mark, objects, triangles, exact answer, a sign for each witness if the unit was asked, the common segment, and why the pair is
/// undecided.
#[derive(Serialize)]
struct Pair(usize, usize, usize, u32, u32, String, Option<String>, Option<[f32; 6]>, Option<String>);

/// Pairs that a page holds; with more of them browsers do not open it.
const MOST: usize = 200_000;

/// Collects what the page shows.
pub struct Viewer<'a, 'b> {
    front: &'b Front<'a>,
    stage: ReadyScene<'a>,
    golden: Golden,
    params: Params,
    frames: Vec<Shown>,
    witnesses: Vec<String>,
    /// Pairs on the page, and those for which there was no more room.
    shown: usize,
    left_out: usize,
}

impl<'a, 'b> Viewer<'a, 'b> {
    /// A viewer of what a unit says, with nothing in it yet.
    pub fn new(front: &'b Front<'a>, params: &Params) -> Self {
        let params = params.clone();
        let stage = ReadyScene::new(front.scene(), &params);
        let witnesses = if params.method == Method::Axes { axes(params.axes.count()) } else { vec![] };
        Self { front, stage, golden: Golden::new(&params), params, frames: vec![], witnesses, shown: 0, left_out: 0 }
    }

    /// Pairs that the page does not hold because it is full.
    pub fn left_out(&self) -> usize {
        self.left_out
    }

    /// Takes the contacts of a frame, each with its exact answer; a frame without contacts is left out.
    pub fn take<C: Counted>(&mut self, row: &Row<C>, contacts: &[Contact]) {
        let (contacts, others) = contacts.split_at(contacts.len().min(MOST - self.shown));
        self.shown += contacts.len();
        self.left_out += others.len();
        if contacts.is_empty() {
            return;
        }
        let scene = self.front.scene();
        let Frame { poses, .. } = scene.frame(row.frame);
        let meetings = self.front.near.meetings(row.frame);
        let mut pairs = vec![];
        for meeting in &meetings {
            let of_meeting = |contact: &&Contact| contact.place.objects == (meeting.a, meeting.b);
            let mut here = contacts.iter().filter(of_meeting).peekable();
            if here.peek().is_none() {
                continue;
            }
            let posed = self.stage.posed(meeting);
            let host = posed.host();
            for contact in here {
                let (p, q) = contact.place.pair;
                let common = contact.touches().then(|| segment(scene, &poses, contact)).flatten();
                let ends = common.map(|[p, q]| [p.x, p.y, p.z, q.x, q.y, q.z].map(|x| x as f32));
                let signs = contact.verdict.and_then(|_| signs(&self.golden, &self.params, &posed, &host, (p, q)));
                let says = signs.map(|(names, signs)| {
                    if self.witnesses.is_empty() {
                        self.witnesses = names;
                    }
                    signs
                });
                let exact = contact.exact.map_or(String::new(), |exact| exact.to_string());
                let reason = reason(&self.golden, &posed, &host, contact).map(in_words);
                pairs.push(Pair(Mark::of(contact) as usize, meeting.a, meeting.b, p, q, exact, says, ends, reason));
            }
        }
        self.frames.push(Shown {
            number: row.frame,
            label: row.label.clone(),
            summary: row.counts.sentence(),
            poses: poses.iter().map(numbers).collect(),
            contacts: pairs,
        });
    }

    /// The page; `command_line` is what generates the design.
    pub fn page(mut self, command_line: &str) -> String {
        let scene = self.front.scene();
        let shown = self.frames.len();
        if self.frames.is_empty() {
            let Frame { label, poses, .. } = scene.frame(0);
            let poses = poses.iter().map(numbers).collect();
            let summary = "In no pose does a pair touch or stay undecided; this is the first pose.".to_owned();
            self.frames.push(Shown { number: 0, label, summary, poses, contacts: vec![] });
        }
        let touching = |frame: &Shown| frame.contacts.len();
        let first = (0..self.frames.len()).rev().max_by_key(|i| touching(&self.frames[*i])).unwrap_or(0);
        let (meshes, mesh_of) = scene.meshes();
        let mesh = |mesh: &&efsat_geometry::mesh::Mesh| Mesh {
            vertices: mesh.vertices().iter().flat_map(|v| [v.x as f32, v.y as f32, v.z as f32]).collect(),
            faces: mesh.faces().iter().flatten().copied().collect(),
        };
        let kind = |mark: Mark| {
            let [red, green, blue] = mark.colour();
            Kind { words: mark.words(), verdict: mark.verdict(), colour: format!("#{red:02x}{green:02x}{blue:02x}") }
        };
        let (witness, words): (_, &[(char, &'static str)]) = match self.params.method {
            Method::Axes => ("axis", &[('s', "separated"), ('o', "overlapping"), ('?', "uncertain")]),
            Method::Determinants | Method::Exact => {
                ("determinant", &[('+', "positive"), ('-', "negative"), ('?', "uncertain")])
            }
        };
        let objects = scene.objects.iter().zip(mesh_of);
        let triangles = |object: &efsat_geometry::scene::Object| match &object.findings.numbers {
            numbers if numbers.are_plain() => vec![],
            numbers => (0..object.mesh.faces().len() as u32).map(|triangle| numbers.name(triangle)).collect(),
        };
        let object = |(object, mesh): (&'a efsat_geometry::scene::Object, usize)| Object {
            name: &object.name,
            mesh,
            triangles: triangles(object),
        };
        let data = Data {
            meshes: meshes.iter().map(mesh).collect(),
            objects: objects.map(object).collect(),
            frames: &self.frames,
            first,
            kinds: Mark::ALL.map(kind),
            witness,
            witnesses: &self.witnesses,
            words: words.iter().copied().collect(),
            silent: "The pair was decided in software, not by the unit.",
        };
        let data = serde_json::to_string(&data).expect("keys are strings and numbers are finite");
        let licence = include_str!("../web/three/LICENSE");
        let page = Page {
            scene: &scene.name,
            command: command_line,
            shown,
            poses: scene.frames(),
            style: include_str!("../web/viewer.css"),
            library: format!("/*\n{licence}*/\n{}", include_str!("../web/three/three.min.js")),
            script: include_str!("../web/viewer.js"),
            // No text in it ends the element.
            data: data.replace('<', "\\u003c"),
            version: env!("CARGO_PKG_VERSION"),
        };
        page.render().expect("the template renders")
    }
}

/// Why a pair is undecided, with its margin.
fn in_words(Reason { words, margin }: Reason) -> String {
    let margin = margin.map(|Margin { gap, error }| format!(" (gap {gap}, error {error}, in units of the last place)"));
    words + &margin.unwrap_or_default()
}

fn numbers(pose: &Pose) -> [f64; 12] {
    let (m, t) = (pose.rotation(), pose.translation());
    std::array::from_fn(|i| if i < 9 { m[(i / 3, i % 3)] } else { t[i - 9] })
}

/// The axes in the order of their flags, and what decides beside them.
fn axes(count: usize) -> Vec<String> {
    let crossed = (0..9).map(|i| format!("C_{}{}", i / 3, i % 3));
    let in_plane = ["A", "B"].into_iter().flat_map(|n| (0..3).map(move |k| format!("n_{n} x e_{n}{k}")));
    let all = ["n_A".to_owned(), "n_B".to_owned()].into_iter().chain(crossed).chain(in_plane).take(count);
    all.chain(["an edge through the other triangle".to_owned()]).collect()
}

/// What each witness says of a pair that the unit was asked, and what they are called; nothing if the host decided it.
fn signs(
    golden: &Golden,
    params: &Params,
    posed: &ReadyMeeting<'_>,
    host: &ScenePose<'_>,
    pair: (u32, u32),
) -> Option<(Vec<String>, String)> {
    let [a, b] = posed.faces(pair);
    let Host::Unit(inputs) = host.pair(a, b) else { return None };
    if params.method != Method::Axes {
        let trace = golden.trace(&host.pose, &inputs).into_iter();
        let signs = trace.filter_map(|(name, value)| Some((name.strip_prefix("sign.")?.to_owned(), value.lo)));
        let sign = |sign: i128| match sign.signum() {
            1 => '+',
            -1 => '-',
            _ => '?',
        };
        return Some(signs.map(|(name, value)| (name, sign(value))).unzip());
    }
    let Outcome { verdict, separated, overlapping, .. } = golden.outcome(&host.pose, &inputs);
    let sign = |axis: usize| match (separated >> axis & 1, overlapping >> axis & 1) {
        (1, _) => 's',
        (_, 1) => 'o',
        _ => '?',
    };
    let eleven = (1 << 11) - 1;
    // Nothing else makes an intersection of a pair whose eleven axes do not all overlap.
    let pierced = verdict == Verdict::Intersect && overlapping & eleven != eleven;
    let edge = if pierced { 'o' } else { '?' };
    Some((vec![], (0..params.axes.count()).map(sign).chain([edge]).collect()))
}
