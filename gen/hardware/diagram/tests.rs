//! Pictures of a small block, whose schedule is known, and of blocks as drawn.

use super::layout::Layout;
use super::*;
use crate::device;
use crate::graph::{Library, Signals};
use crate::op::{self, Magnitude, Type};
use crate::schedule::Scheduler;

/// y = a * b, then z = |y + c| behind it, with c waiting for the product, and a node that nothing needs.
fn block() -> Rc<Block> {
    let library = Library::default();
    library.block("sample", &["A product and a sum, |a b + c|. For tests", "alone."], 1, |top| {
        let [a, b, c] = ["in_a", "in_b", "in_c"].map(|name| top.input(Type::signed(8, 4), (-100, 100)).named(name));
        let product = (a * b).named("product");
        let sum = (product.floor(4).named("product_floor") + c).named("sum");
        let _ = (-c).named("forgotten");
        sum.apply(Magnitude, &[]).named("magnitude")
    })
}

fn picture() -> Picture {
    let device = device::find("xc2v6000-4").unwrap();
    let mut scheduler = Scheduler::new(device, 100);
    Picture::new(&scheduler.schedule(&block()), scheduler.period())
}

fn find<'a>(picture: &'a Picture, name: &str) -> (usize, &'a Place) {
    picture.places.iter().enumerate().find(|(_, place)| place.name == name).unwrap()
}

#[test]
fn boxes_stand_in_their_clocks_and_values_wait_in_registers() {
    let picture = picture();
    assert_eq!(picture.what, "A product and a sum, |a b + c|.");
    let names: Vec<&str> = picture.places.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["in_a", "in_b", "in_c", "product", "product_floor", "sum", "magnitude", "magnitude"]);
    let (product, place) = find(&picture, "product");
    assert_eq!(
        (place.start, place.operation.as_str(), place.kind),
        (0, "in_a \u{d7} in_b", Kind::Operation(op::Kind::Product))
    );
    let (sum, place) = find(&picture, "sum");
    assert!(place.start >= 1 && place.start == picture.places[product].from);
    let waiting = picture.edges.iter().find(|e| e.from == find(&picture, "in_c").0).unwrap();
    assert_eq!((waiting.to, waiting.registers, waiting.format.as_str()), (sum, place.start, "s4.4"));
    let last = picture.edges.last().unwrap();
    assert_eq!((last.from, last.to), (find(&picture, "magnitude").0, picture.places.len() - 1));
}

#[test]
fn the_critical_path_is_the_longest_chain_of_one_clock() {
    let picture = picture();
    let latest = picture.places.iter().map(|p| p.ns).fold(0.0, f64::max);
    let path: Vec<&Place> = picture.places.iter().filter(|p| p.critical).collect();
    assert!(path.iter().any(|p| p.ns == latest), "{path:?}");
    assert!(path.iter().all(|p| p.from == path[0].from), "{path:?}");
    let marked: Vec<&Edge> = picture.edges.iter().filter(|e| e.critical).collect();
    assert!(!marked.is_empty() && marked.iter().all(|e| e.registers == 0));
    assert!(picture.longest.contains(&format!("{latest:.2} ns of 10.00 ns")), "{}", picture.longest);
}

/// Items of a layer keep clear of each other, and every edge goes from left to right.
#[test]
fn nothing_is_drawn_over_another_thing() {
    let device = device::find("xc2v6000-4").unwrap();
    let mut scheduler = Scheduler::new(device, 100);
    let picture = Picture::new(&scheduler.schedule(&block()), scheduler.period());
    let layout = Layout::new(&picture);
    let mut wrong = vec![];
    for (i, a) in layout.items.iter().enumerate() {
        for (j, b) in layout.items.iter().enumerate().skip(i + 1) {
            let together = a.layers.0 <= b.layers.1 && b.layers.0 <= a.layers.1;
            if together && (a.y - b.y).abs() < (a.height + b.height) / 2.0 {
                wrong.push((i, j));
            }
        }
    }
    assert_eq!(wrong, []);
    for edge in &picture.edges {
        assert!(layout.items[edge.from].layers.1 < layout.items[edge.to].layers.0, "{edge:?}");
    }
}

#[test]
fn both_forms_are_whole_and_the_same_each_time() {
    let (one, two) = (picture(), picture());
    assert_eq!((one.svg(), one.dot()), (two.svg(), two.dot()));
    let svg = one.svg();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n") && !svg.contains("NaN") && !svg.contains("inf"));
    let places = one.places.len();
    assert!(svg.matches("text-anchor=\"middle\" font-weight=\"bold\"").count() == places);
    assert!(svg.matches("marker-end").count() == one.edges.len() && svg.contains(">s4.4<"));
    let dot = one.dot();
    assert!(dot.matches("->").count() == one.edges.len() && dot.matches("subgraph").count() >= 2);
    assert_eq!(dot.matches('{').count(), dot.matches('}').count());
}
