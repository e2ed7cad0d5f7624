//! Names from structure.

use super::*;
use efsat_hardware::dump;
use efsat_hardware::entity;
use efsat_hardware::graph::{Phases, Signals, Vec3};
use expect_test::expect;

#[test]
fn what_has_one_reader_is_called_after_it_and_what_has_more_after_its_source() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let shared = a.floor(2);
        let y = (shared * b.floor(1)).named("y");
        let z = (shared.magnitude() - b.floor(3).magnitude().floor(-1)).named("z");
        vec![y, z, (-(a + b)).called("opposite").resize(Type::signed(12, 4)).named("w")]
    });
    expect![[r#"
        block sample, 1 phase
          a                              s4.4  -128..127    pair  Input
          b                              s4.4  -128..127    pair  Input
          (a_floor_2)                    s4.2  -32..31      pair  Floor(2) a
          (y_floor_1)                    s4.3  -64..63      pair  Floor(1) b
          y                              s8.5  -2016..2048  pair  Multiply a_floor_2, y_floor_1
          (z_magnitude)                  u4.2  0..32        pair  Magnitude a_floor_2
          (z_aligned_magnitude_floor_3)  s4.1  -16..15      pair  Floor(3) b
          (z_aligned_magnitude)          u4.1  0..16        pair  Magnitude z_aligned_magnitude_floor_3
          (z_aligned)                    u4.2  0..32        pair  Append(1) z_aligned_magnitude
          z                              s5.2  -32..32      pair  Subtract z_magnitude, z_aligned
          (w_opposite_sum)               s5.4  -256..254    pair  Add a, b
          (w_opposite)                   s6.4  -254..256    pair  Negate w_opposite_sum
          w                              s8.4  -254..256    pair  Resize(s8.4) w_opposite
          output y: y
          output z: z
          output w: w
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn operands_of_one_kind_are_told_apart_by_their_place() {
    let block = block(1, |top| {
        let [a, b, c] = ["a", "b", "c"].map(|name| top.input(S8, ALL).named(name));
        vec![((a + b) * (b + c)).named("y"), ((a * b) + (b * c)).named("z")]
    });
    expect![[r#"
        block sample, 1 phase
          a                   s4.4   -128..127      pair  Input
          b                   s4.4   -128..127      pair  Input
          c                   s4.4   -128..127      pair  Input
          (y_sum_first)       s5.4   -256..254      pair  Add a, b
          (y_sum_second)      s5.4   -256..254      pair  Add b, c
          y                   s10.8  -65024..65536  pair  Multiply y_sum_first, y_sum_second
          (z_product_first)   s8.8   -16256..16384  pair  Multiply a, b
          (z_product_second)  s8.8   -16256..16384  pair  Multiply b, c
          z                   s9.8   -32512..32768  pair  Add z_product_first, z_product_second
          output y: y
          output z: z
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn instances_and_their_ports() {
    let block = block(1, |top| {
        let [v, w] = ["v", "w"].map(|name| Vec3::each(|_| top.input(S8, ALL)).named(name));
        let inner = |v: Vec3<_>| entity!("negated", &[], (v) => v.map(|x: Sig| -x).named("n"));
        let chain = inner(v).map(|x| x.bits(8 + 1));
        let summed = entity!("sum", &[], (chain) => (chain[0] + chain[1]).named("s"));
        vec![summed.named("y"), inner(w)[2].named("z")]
    });
    expect![[r#"
        block sample, 1 phase
          v_x             s4.4  -128..127  pair  Input
          v_y             s4.4  -128..127  pair  Input
          v_z             s4.4  -128..127  pair  Input
          w_x             s4.4  -128..127  pair  Input
          w_y             s4.4  -128..127  pair  Input
          w_z             s4.4  -128..127  pair  Input
          (v_x_n_x_unit)  flag  0..0       pair  Instance of negated v_x, v_y, v_z
          (v_x_n_x)       s5.4  -127..128  pair  Output n_x v_x_n_x_unit
          (v_x_n_y)       s5.4  -127..128  pair  Output n_y v_x_n_x_unit
          (v_x_n_z)       s5.4  -127..128  pair  Output n_z v_x_n_x_unit
          (y_unit)        flag  0..0       pair  Instance of sum v_x_n_x, v_x_n_y, v_x_n_z
          y               s6.4  -254..256  pair  Output s y_unit
          (w_x_n_x_unit)  flag  0..0       pair  Instance of negated w_x, w_y, w_z
          (w_x_n_x)       s5.4  -127..128  pair  Output n_x w_x_n_x_unit
          (w_x_n_y)       s5.4  -127..128  pair  Output n_y w_x_n_x_unit
          z               s5.4  -127..128  pair  Output n_z w_x_n_x_unit
          output y: y
          output z: z
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn selects_are_called_after_the_bundle_that_they_choose() {
    let block = block(2, |top| {
        let [v, w] = ["v", "w"].map(|name| Vec3::each(|_| top.input(S8, ALL)).named(name));
        let x = Phases::new(2, |s| Some([v, w][s])).mux().named("x");
        x.capture(1, false).named("y").signals()
    });
    expect![[r#"
        block sample, 2 phases
          v_x         s4.4  -128..127  pair   Input
          v_y         s4.4  -128..127  pair   Input
          v_z         s4.4  -128..127  pair   Input
          w_x         s4.4  -128..127  pair   Input
          w_y         s4.4  -128..127  pair   Input
          w_z         s4.4  -128..127  pair   Input
          (x_select)  flag  0..1       phase  Phase 0 1
          x_x         s4.4  -128..127  phase  Mux x_select, v_x, w_x
          x_y         s4.4  -128..127  phase  Mux x_select, v_y, w_y
          x_z         s4.4  -128..127  phase  Mux x_select, v_z, w_z
          y_x         s4.4  -128..127  pair   Capture of phase 1 x_x
          y_y         s4.4  -128..127  pair   Capture of phase 1 x_y
          y_z         s4.4  -128..127  pair   Capture of phase 1 x_z
          output y_x: y_x
          output y_y: y_y
          output y_z: y_z
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn what_cannot_be_told_apart_is_refused() {
    let refused =
        |body: for<'l> fn(Sig<'l>) -> Vec<Sig<'l>>| refusal(|| block(1, |top| body(top.input(S8, ALL).named("a"))));
    lines(
        expect![[r#"
            block sample: two nodes are called y: Comb(Negate(Negate(None))) and Comb(Magnitude(Magnitude))
            block sample: an output has no name (Comb(Negate(Negate(None))))
            not refused
        "#]],
        [
            refused(|a| vec![(-a).named("y"), a.magnitude().named("y")]),
            refused(|a| vec![-a]),
            refused(|a| {
                let (x, y) = (-a, -a);
                vec![(x * x).named("x"), (y * y).named("y")]
            }),
        ],
    );
}
