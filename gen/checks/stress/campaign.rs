//! The campaign: every case of a plan, written in every way, asked, and compared with the exact answer.

use super::fault::{Asked, Fault, Kind};
use super::hash::{BASIS, fnv};
use super::variants::{Variant, vertex_orders};
use super::{Answerer, Counts, Family, Posed, Report, VertexOrder, ladder, truth};
use efsat_geometry::exact::Exact;
use efsat_unit::host::Answer;
use efsat_unit::pair::Verdict;
use efsat_unit::params::Params;
use rayon::prelude::*;

/// Which cases are asked.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The families, each with as many cases as the others, or one more.
    pub families: Vec<&'static Family>,
    /// The number of cases of all families together.
    pub pairs: u64,
    /// The index of the first case of each family.
    pub first: u64,
    /// The seed of all cases.
    pub seed: u64,
}

/// A parameter set of the ladder, as a command line has it, and who answers for it.
struct Rung<A> {
    options: String,
    answerer: A,
}

/// One parameter set under stress.
pub struct Campaign<A> {
    params: Params,
    answerer: A,
    ladder: Vec<Rung<A>>,
    orders: Vec<VertexOrder>,
}

impl<A: Answerer> Campaign<A> {
    /// Prepares a campaign. `answerer` makes who is asked, for the given and for the other parameters of the ladder.
    pub fn new(params: &Params, answerer: impl Fn(&Params) -> A) -> Self {
        let rung = |rung: &Params| Rung { options: ladder::difference(rung, params), answerer: answerer(rung) };
        Self {
            params: params.clone(),
            answerer: answerer(params),
            ladder: ladder::rungs(params).iter().map(rung).collect(),
            orders: vertex_orders(),
        }
    }

    /// Runs a plan on all threads; `done` is called after every case.
    pub fn run(&self, plan: &Plan, done: &(impl Fn() + Sync)) -> Report {
        let empty = || Report::new(&plan.families);
        let families = plan.families.len() as u64;
        let one = |mut report: Report, number: u64| {
            let (family, index) = ((number % families) as usize, plan.first + number / families);
            self.case(plan, family, index, &mut report);
            done();
            report
        };
        (0..plan.pairs).into_par_iter().fold(empty, one).reduce(empty, Report::merged)
    }

    /// One case: as made and again, in every other way, on every rung; then under a pose, in all orders of vertices,
    /// and on one rung, in turn.
    fn case(&self, plan: &Plan, family: usize, index: u64, report: &mut Report) {
        let (family, counts) = &mut report.families[family];
        let (points, mut rng) = family.case(plan.seed, index);
        let mut case =
            Case { counts, hash: fnv(fnv(BASIS, family.name.as_bytes()), &index.to_le_bytes()), found: None };

        let answers = truth::loose(&points);
        let exact = answers.class();
        case.counts.truths.count(exact);
        case.compare_formulations(&answers, || ("as made".to_owned(), Asked::Loose(points)));
        let given = self.answerer.loose(&points);
        let variants = Variant::all(&points, &mut rng);
        case.take(given, exact, || (Variant::Given.to_string(), Asked::Loose(points)));
        for variant in [Variant::Given].into_iter().chain(variants) {
            let written = variant.of(&points);
            let answer = self.answerer.loose(&written);
            let asked = || (variant.to_string(), Asked::Loose(written));
            case.take(answer, exact, asked);
            if variant.is_normalised_away() {
                case.compare_verdicts(answer.verdict, given.verdict, asked);
            }
        }
        for rung in &self.ladder {
            case.take(rung.answerer.loose(&points), exact, || (rung.options.clone(), Asked::Loose(points)));
        }

        let posed = Posed::random(&points, &mut rng);
        let answers = truth::posed(&posed);
        let exact = answers.class();
        case.compare_formulations(&answers, || ("posed".to_owned(), Asked::Posed(posed)));
        for (answer, order) in self.answerer.posed(&posed, &self.orders).into_iter().zip(&self.orders) {
            case.take(answer, exact, || (format!("posed, vertices {order:?}"), Asked::Posed(posed)));
        }
        let rung = &self.ladder[(index % self.ladder.len() as u64) as usize];
        for answer in rung.answerer.posed(&posed, &self.orders[..1]) {
            case.take(answer, exact, || (format!("posed, {}", rung.options), Asked::Posed(posed)));
        }

        let Case { hash, found, .. } = case;
        report.digest = report.digest.wrapping_add(hash);
        if let Some((kind, variant, asked)) = found {
            let name = family.name;
            let options = ladder::difference(&self.params, &Params::default());
            let words = ["efsat stress", &options, &format!("--seed {} --family {name}", plan.seed)];
            let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
            let replay = format!("{} --first {index} --pairs 1", words.join(" "));
            report.keep(Fault { kind, family: name, index, variant, asked, replay });
        }
    }
}

/// A case in work.
struct Case<'a> {
    counts: &'a mut Counts,
    /// Of all verdicts so far.
    hash: u64,
    /// The first fault.
    found: Option<(Kind, String, Asked)>,
}

impl Case<'_> {
    /// Counts an answer and compares it with the exact one.
    fn take(&mut self, answer: Answer, truth: Exact, asked: impl FnOnce() -> (String, Asked)) {
        self.counts.count_answer(answer);
        self.hash = fnv(self.hash, &[answer.verdict as u8]);
        let verdict = answer.verdict;
        if verdict.is_wrong(truth) {
            self.blame(Kind::Wrong { verdict, truth }, asked);
        }
    }

    fn compare_formulations(&mut self, answers: &truth::Answers, asked: impl FnOnce() -> (String, Asked)) {
        if !answers.agree() {
            self.blame(Kind::Disagreement(*answers), asked);
        }
    }

    fn compare_verdicts(&mut self, verdict: Verdict, given: Verdict, asked: impl FnOnce() -> (String, Asked)) {
        if verdict != given {
            self.blame(Kind::Unstable { verdict, given }, asked);
        }
    }

    fn blame(&mut self, kind: Kind, asked: impl FnOnce() -> (String, Asked)) {
        self.counts.count_fault(&kind);
        self.found.get_or_insert_with(|| {
            let (variant, asked) = asked();
            (kind, variant, asked)
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_geometry::exact::Relation;

    /// The exact formulations agree, as far as is known, so that no case can show this.
    #[test]
    fn formulations_that_contradict_each_other_are_counted() {
        let mut counts = Counts::default();
        let mut case = Case { counts: &mut counts, hash: BASIS, found: None };
        let asked = || ("as made".to_owned(), Asked::Loose([[0.0; 3]; 6]));
        let touch = Relation { class: Exact::Touch, coplanar: false };
        let one = truth::Answers { facets: touch, programme: touch, retest: Exact::Touch };
        case.compare_formulations(&one, asked);
        assert_eq!(case.found, None);
        for other in [
            truth::Answers { programme: Relation { coplanar: true, ..touch }, ..one },
            truth::Answers { programme: Relation { class: Exact::Separate, ..touch }, ..one },
            truth::Answers { retest: Exact::Intersect, ..one },
        ] {
            case.compare_formulations(&other, asked);
        }
        let first = "disagreement: facets touch, linear programme touch and coplanar, retest touch";
        assert_eq!(case.found.map(|(kind, ..)| kind.to_string()), Some(first.to_owned()));
        assert_eq!(counts.disagreements, 3);
    }
}
