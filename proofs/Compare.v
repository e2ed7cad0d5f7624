(** The functions that are proved, run on the words that the reference models answer.

    A test of the generator prints groups of numbers: the options of a design with its tables, and cases, each the words of a pair
    and all that the reference model says of it: verdict, flags, and inner numbers, those of the axis unit as one digest for each
    stage. Here are the readers of these numbers, and [differences], the cases in which the function of the proof says something
    else. There shall be none. *)
From Coq Require Import ZArith List Bool.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.Triple Efsat.Verdict Efsat.RealSpace Efsat.Interval Efsat.Determinants.
Require Efsat.DeterminantUnit Efsat.AxisUnit Efsat.AxisRanges Efsat.Cascade.
Import ListNotations.
Local Open Scope Z_scope.

Definition group := (list Z * list (list Z))%type.
Definition at_ (l : list Z) i := nth i l 0.
Definition flag x := negb (x =? 0).
Definition vector l i := Z3 (at_ l i) (at_ l (1 + i)) (at_ l (2 + i)).
Definition vectors l i := Tri (vector l i) (vector l (3 + i)) (vector l (6 + i)).
Definition numbers_of v := [ZX v; ZY v; ZZ v].
Definition bits_of (l : list bool) := fold_right (fun (b : bool) n => 2 * n + if b then 1 else 0) 0 l.
Definition code a := match a with DeterminantUnit.Separate => 0 | DeterminantUnit.Intersect => 1 | DeterminantUnit.Unknown => 2 end.
Definition sign_code s := match s with Sign.N => -1 | O => 0 | P => 1 end.
Fixpoint same (a b : list Z) := match a, b with [], [] => true | x :: a, y :: b => if x =? y then same a b else false | _, _ => false end.
(** The groups and cases with another answer. Each case has so many words. *)
Definition differences (words : nat) (answer : list Z -> list Z -> list Z) (groups : list group) : list (nat * nat) :=
  flat_map (fun '(g, (options, cases)) => flat_map (fun '(n, l) => if same (answer options (firstn words l)) (skipn words l) then [] else [(g, n)])
    (combine (List.seq 0 (length cases)) cases)) (combine (List.seq 0 (length groups)) groups).
Definition all_valid (valid : list Z -> bool) (groups : list group) := forallb (fun g => valid (fst g)) groups.

(** * Determinants *)
Definition transform_of x := if x =? 0 then DeterminantUnit.Off else if x =? 1 then DeterminantUnit.Translate else DeterminantUnit.On.
Definition kind_of x := if x =? 0 then Static else if x =? 1 then Edges else if x =? 2 then Norms else Products.
Definition options_of l := DeterminantUnit.Options (at_ l 0) (at_ l 1) (transform_of (at_ l 2)) (at_ l 3) (at_ l 4) (at_ l 5) (at_ l 6) (kind_of (at_ l 7)) (flag (at_ l 8)).
(** Vertices of A and of B, rows of M, t, and whether the pose is bypassed. *)
Definition words_of l := DeterminantUnit.Words (vectors l 0) (vectors l 9) (vectors l 18) (vector l 27) (flag (at_ l 30)).
Definition points_numbers x := numbers_of (V1 x) ++ numbers_of (V2 x) ++ flat_map numbers_of (to_list (W x)).
Definition of_computed (c : DeterminantUnit.computed) :=
  let o := DeterminantUnit.outcome_of c in let y := DeterminantUnit.at_coordinates c in let r := DeterminantUnit.of_moments c in
  [code (DeterminantUnit.verdict o); bits_of (DeterminantUnit.separated o); bits_of (DeterminantUnit.overlapping o);
   DeterminantUnit.dx y; DeterminantUnit.dy y; DeterminantUnit.dz y; DeterminantUnit.level y]
  ++ points_numbers (DeterminantUnit.at_ y) ++ flat_map numbers_of (to_list (m r)) ++ numbers_of (n r) ++ [DeterminantUnit.shift c]
  ++ all_of (DeterminantUnit.fifteen_of c) ++ all_of (DeterminantUnit.bounds_of c) ++ map sign_code (DeterminantUnit.signs_of c).
Definition determinants_answer options l :=
  let o := options_of options in let x := DeterminantUnit.differences o (words_of l) in points_numbers x ++ of_computed (DeterminantUnit.of_differences o x).
Definition determinants_valid l := DeterminantUnit.valid (options_of l).

(** * Exact *)
Definition of_points {A} (rule : I.S.vec -> I.S.vec -> I.S.vec -> I.S.vec -> I.S.vec -> A) x : A :=
  let g := Cascade.on_grid in rule (g (V1 x)) (g (V2 x)) (g (W x T0)) (g (W x T1)) (g (W x T2)).
(** Verdict, both words of flags, and the fifteen determinants, of a pair that fits. *)
Definition exact_answer options l :=
  let x := DeterminantUnit.differences (options_of options) (words_of l) in
  let numbers := of_points I.S.fifteen x in
  let signs := map Integers.sg numbers in let f v := nth (place v) signs O in
  let separate := of_points I.separate x in
  let flat := forallb (fun v => seq (f v) O) [1; 2; 3; 4; 5; 6]%positive in
  let area i j k := I.S.cross (I.S.minus j i) (I.S.minus k i) in
  let alike := of_points (fun v1 v2 w0 w1 w2 => IK.crosses v1 v2 w0 w1 w2 && (0 <? I.S.dot (I.S.cross v1 v2) (area w0 w1 w2))) x in
  let reach := 2 ^ (DeterminantUnit.width (options_of options) - 1) - 1 in
  if forallb (fun y => Z.abs y <=? reach) (points_numbers x) then
    [if separate then 0 else 1; bits_of ((flat && separate) :: one_side f [1; 2; 3]%positive :: one_side f [4; 5; 6]%positive :: map (at_edge misses f) edge_list);
     bits_of (of_points IK.crosses x :: (flat && forallb (fun v => seq (f v) O) [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive) :: (existsb (at_edge pierces f) edge_list || flat && alike) :: map (at_edge hits f) edge_list)] ++ numbers
  else [2; 0; 0].
Definition cascade_answer options l :=
  let x := DeterminantUnit.differences (options_of options) (words_of l) in
  let reach := 2 ^ (DeterminantUnit.width (options_of options) - 1) - 1 in
  if forallb (fun y => Z.abs y <=? reach) (points_numbers x) then
    code (Cascade.cascade x) :: of_computed (DeterminantUnit.of_differences Cascade.first_stage (Cascade.scaled x)) else [2].

(** * Axes *)
Definition saturated_of x := if x <? 0 then None else Some x.
Definition format_at l i := AxisUnit.Format (at_ l i) (saturated_of (at_ l (1 + i))).
Definition formats_at l i := Tri (format_at l i) (format_at l (2 + i)) (format_at l (4 + i)).
Definition table_of l := AxisUnit.Table (at_ l 0) (at_ l 1) (at_ l 2) (flag (at_ l 3)) (transform_of (at_ l 4)) (flag (at_ l 5)) (at_ l 6) (flag (at_ l 7))
  (if at_ l 8 =? 0 then AxisUnit.All else if at_ l 8 =? 1 then AxisUnit.Skip else AxisUnit.Intersected) (flag (at_ l 9)) (flag (at_ l 10)) (at_ l 11)
  (formats_at l 12) (format_at l 18) (format_at l 20) (format_at l 22) (formats_at l 24) (formats_at l 30) (format_at l 36)
  (at_ l 38) (at_ l 39) (Tri (at_ l 40) (at_ l 41) (at_ l 42)) (Tri (at_ l 43) (at_ l 44) (at_ l 45)) (at_ l 46).
(** Words come in pairs: the floor, and whether the number is off the grid. *)
Definition word l i := (at_ l i, flag (at_ l (1 + i))).
Definition three_words l i := Tri (word l i) (word l (2 + i)) (word l (4 + i)).
Definition nine_words l i := Tri (three_words l i) (three_words l (6 + i)) (three_words l (12 + i)).
Definition axis_words l := AxisUnit.Words (nine_words l 0) (nine_words l 18) (nine_words l 36) (three_words l 54) (flag (at_ l 60)).
(** One number for many. *)
Definition digest (l : list Z) := fold_left (fun h x => (h * 1000003 + x) mod (2 ^ 61 - 1)) l 0.
Definition ends a := [lo a; hi a].
Definition vector_ends (v : AxisUnit.ivec) := flat_map ends (to_list v).
Definition triple_ends (x : triple AxisUnit.ivec) := flat_map vector_ends (to_list x).
Definition enclosure (x : AxisUnit.ivec * AxisUnit.ivec) := let '(a, b) := x in
  let of f (v : AxisUnit.ivec) := [f lo v; f hi v] in of AxisUnit.least a ++ of AxisUnit.most a ++ of AxisUnit.least b ++ of AxisUnit.most b.
Definition axes_answer options l :=
  let o := table_of options in let i := axis_words l in
  let b := tab (AxisUnit.placed o i) in let a := tab (fun k => AxisUnit.reads o (AxisUnit.A i k)) in
  let p := AxisUnit.prepared o (AxisUnit.normalised o a b) in let r := AxisUnit.decided o p in
  [code (DeterminantUnit.verdict r); bits_of (DeterminantUnit.separated r); bits_of (DeterminantUnit.overlapping r);
   digest (triple_ends b); digest (triple_ends (AxisUnit.points_a p) ++ triple_ends (AxisUnit.points_b p)); digest (triple_ends (AxisUnit.edges_a p) ++ triple_ends (AxisUnit.edges_b p));
   digest (flat_map (fun x => vector_ends (AxisUnit.direction o p x)) (AxisUnit.axes o));
   digest (flat_map (fun x => enclosure (AxisUnit.compared o x (AxisUnit.images o p x))) (AxisUnit.axes o))].
Definition axes_valid l := AxisRanges.valid (table_of l) || AxisRanges.no_saturation (table_of l).
