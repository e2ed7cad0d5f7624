(** The determinant unit from its words to its verdict: sections 2, 3 and 6 of docs/determinants.md, proved as in its sections
    7.1, 7.2 and 7.6 to 7.8.

    The words of the unit are the floors of the user's numbers. Whatever these are, within the declared ranges if there is a
    frame transform, `separate` is the answer only for triangles without a common point, and `intersect` only for triangles with
    one: [determinant_unit_is_right]. The triangles are closed ones of real space, B as it is moved by the true pose. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.Triple Efsat.Verdict Efsat.RealSpace Efsat.Vectors Efsat.Determinants.
Import ListNotations.
Local Open Scope Z_scope.

(** * What the unit computes *)
Inductive transform := Off | Translate | On.
Record options := Options { width : Z; fraction : Z; moves : transform; fine : Z; least : Z; greatest : Z; span : Z; bound : kind; boxes : bool }.
(** The error of a difference, in ulps. *)
Definition difference_error t := match t with Off => 1 | Translate => 2 | On => 5 end.
Definition valid o : bool := (6 <=? width o) && (2 <=? fraction o) && (0 <=? least o) && (0 <=? greatest o) && (greatest o <=? 6)
  && (fine o <=? greatest o + 1) && (8 * difference_error (moves o) <=? 2 ^ fine o) && (8 * difference_error (moves o) <=? 4 + 2 ^ greatest o)
  && (0 <=? span o) && (span o <=? width o).

(** Section 2. *)
Record words := Words { A : triple zvec; B : triple zvec; M : triple zvec; t : zvec; bypass : bool }.
Definition middle v := Z3 (2 * ZX v + 1) (2 * ZY v + 1) (2 * ZZ v + 1).
Definition left_out f := let q := Z.max (f + 3 - 18) 0 in if 2 * q <=? f then q else 0.
Definition row f (v w : zvec) :=
  let q := left_out f in let low x := x mod 2 ^ q in let part x y := x * y - low x * low y in
  let middle := if q =? 0 then 0 else 3 * 2 ^ (2 * q - 1) in
  (part (ZX v) (ZX w) + part (ZY v) (ZY w) + part (ZZ v) (ZZ w) + middle + 2 ^ (f + 1)) / 2 ^ (f + 2).
Definition zplus u v := Z3 (ZX u + ZX v) (ZY u + ZY v) (ZZ u + ZZ v).
Definition placed o i l := match moves o, bypass i with
  | Off, _ | _, true => B i l
  | Translate, _ => zplus (B i l) (t i)
  | On, _ => let r j := row (fraction o) (middle (M i j)) (middle (B i l)) in zplus (Z3 (r T0) (r T1) (r T2)) (t i) end.
Definition differences o i := let o0 := A i T0 in Points (zminus (A i T1) o0) (zminus (A i T2) o0) (tab (fun l => zminus (placed o i l) o0)).

(** Section 3. *)
Definition along (c : zvec -> Z) x := [c (V1 x); c (V2 x); c (W x T0); c (W x T1); c (W x T2)].
Definition length_of xs := let all := fold_right (fun x all => Z.lor (Z.abs x) all) 0 xs in if all =? 0 then 0 else Z.log2 all + 1.
Definition dropped o xs :=
  let d := Z.max (length_of xs + 1 - width o) (least o) in
  if existsb (fun x => 2 ^ (width o - 1) <=? Z.abs (round x d)) xs then d + 1 else d.
Definition level_of o d := Z.min (Z.max (fine o - d) 0) (greatest o).
Record coordinates := Coordinates { at_ : points; dx : Z; dy : Z; dz : Z; level : Z }.
Definition coordinates_of o x :=
  let dx := dropped o (along ZX x) in let dy := dropped o (along ZY x) in let dz := dropped o (along ZZ x) in
  let to v := Z3 (round (ZX v) dx) (round (ZY v) dy) (round (ZZ v) dz) in
  Coordinates (Points (to (V1 x)) (to (V2 x)) (tab (fun l => to (W x l)))) dx dy dz (Z.max (level_of o dx) (Z.max (level_of o dy) (level_of o dz))).

(** Section 4: the shift of the moments. *)
Definition components r := flat_map (fun v => [ZX v; ZY v; ZZ v]) (to_list (m r) ++ [n r]).
Definition fits_shift N r s := forallb (fun c => (- 2 ^ (N - 1) <=? round c s) && (round c s <? 2 ^ (N - 1))) (components r).
Fixpoint shift_from (tries : nat) N r s := match tries with 0%nat => s | S tries => if fits_shift N r s then s else shift_from tries N r (s + 1) end.
Definition shift_of o r := shift_from (Z.to_nat (span o)) (width o) r (width o - span o).

(** Section 6. *)
Definition box_gap level := 2 + 2 ^ level / 4.
Definition boxes_apart gap x :=
  let least a b c := Z.min (Z.min a b) c in let most a b c := Z.max (Z.max a b) c in
  existsb (fun c => (gap <=? least 0 (c (V1 x)) (c (V2 x)) - most (c (W x T0)) (c (W x T1)) (c (W x T2)))
    || (gap <=? least (c (W x T0)) (c (W x T1)) (c (W x T2)) - most 0 (c (V1 x)) (c (V2 x)))) [ZX; ZY; ZZ].
Inductive answer := Separate | Intersect | Unknown.
Record outcome := Outcome { verdict : answer; separated : list bool; overlapping : list bool }.
Definition to_sign z := if z =? 1 then P else if z =? -1 then N else O.
Definition sign_at (signs : list sign) v := nth (place v) signs O.
Definition decided apart signs :=
  let f := sign_at signs in
  let missed := map (at_edge misses f) edge_list in let pierced := map (at_edge pierces f) edge_list in
  let a := one_side f [1; 2; 3]%positive in let b := one_side f [4; 5; 6]%positive in
  Outcome (if apart || a || b || Nat.leb 5 (length (filter (fun x => x) missed)) then Separate else if existsb (fun x => x) pierced then Intersect else Unknown)
    (apart :: a :: b :: missed) (false :: false :: false :: pierced).
Record computed := Computed { at_coordinates : coordinates; shift : Z; of_moments : moments; fifteen_of : fifteen; bounds_of : fifteen; signs_of : list sign; outcome_of : outcome }.
Definition of_differences o x :=
  let y := coordinates_of o x in let r := exact_moments (at_ y) in let s := shift_of o r in let r' := rounded s r in
  let numbers := numbers (at_ y) r' in let bounds := bounds (bound o) (width o) s (level y) (at_ y) r' in
  let signs := map (fun p => to_sign (certain_sign (fst p) (snd p))) (combine (all_of numbers) (all_of bounds)) in
  Computed y s r' numbers bounds signs (decided (boxes o && boxes_apart (box_gap (level y)) (at_ y)) signs).
Definition unit o i := outcome_of (of_differences o (differences o i)).

(** * Section 7.1: coordinates *)
Definition close r (u : zvec) (v : vec) := (Rabs (IZR (ZX u) - X v) <= r /\ Rabs (IZR (ZY u) - Y v) <= r /\ Rabs (IZR (ZZ u) - Z_ v) <= r)%R.

Lemma log2_all x xs : In x xs -> Z.abs x < 2 ^ length_of xs.
Proof.
  unfold length_of. set (all := fold_right _ 0 xs). intros I.
  assert (K : 0 <= all /\ (In x xs -> Z.abs x = 0 \/ (all <> 0 /\ Z.log2 (Z.abs x) <= Z.log2 all))).
  { unfold all. clear. induction xs as [|y ys [H K]]; cbn; [split; [lia|tauto]|].
    split; [apply Z.lor_nonneg; split; auto; lia|]. intros [<-|I].
    - destruct (Z.eq_dec (Z.abs y) 0); [now left|right]. split; [intros E; apply Z.lor_eq_0_iff in E; tauto|].
      rewrite Z.log2_lor by (auto; lia). lia.
    - destruct (K I) as [E|[E L]]; [now left|right]. split; [intros F; apply Z.lor_eq_0_iff in F; tauto|].
      rewrite Z.log2_lor by (auto; lia). lia. }
  destruct K as [H K]. destruct (K I) as [E|[E L]]; destruct (Z.eqb_spec all 0) as [Z0|NZ]; try tauto; rewrite ?E.
  - reflexivity.
  - apply Z.pow_pos_nonneg; [lia|]. pose proof (Z.log2_nonneg all). lia.
  - destruct (Z.eq_dec (Z.abs x) 0) as [->|N0]; [apply Z.pow_pos_nonneg; pose proof (Z.log2_nonneg all); lia|].
    pose proof (Z.log2_spec (Z.abs x) ltac:(lia)) as [_ S]. eapply Z.lt_le_trans; [exact S|]. apply Z.pow_le_mono_r; lia.
Qed.
Lemma dropped_fits o xs x : valid o = true -> In x xs -> Z.abs (round x (dropped o xs)) <= 2 ^ (width o - 1) - 1.
Proof.
  intros V I. unfold valid in V. rewrite !andb_true_iff, !Z.leb_le in V. destruct V as [[[[[[[[[V1 V2] V3] V4] V5] V6] V7] V8] V9] V10].
  unfold dropped. set (d := Z.max _ _). destruct (existsb _ xs) eqn:E.
  - pose proof (log2_all x xs I) as L.
    assert (B : Z.abs x < 2 ^ (d + width o - 1)) by (eapply Z.lt_le_trans; [exact L|]; apply Z.pow_le_mono_r; lia).
    assert (Q : 2 ^ (d + width o - 1) = 2 ^ (d + 1) * 2 ^ (width o - 2)) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
    assert (Q' : 2 ^ (width o - 1) = 2 * 2 ^ (width o - 2)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
    assert (P : 0 < 2 ^ (d + 1)) by (apply Z.pow_pos_nonneg; lia).
    assert (R : 16 <= 2 ^ (width o - 2)) by (change 16 with (2 ^ 4); apply Z.pow_le_mono_r; lia).
    assert (H : 2 ^ (d + 1) / 2 = 2 ^ d) by (rewrite Z.pow_add_r by lia; apply Z.div_mul; lia).
    assert (H' : 2 ^ (d + 1) = 2 * 2 ^ d) by (rewrite Z.pow_add_r by lia; lia).
    unfold round. rewrite H.
    pose proof (Z.mul_div_le (x + 2 ^ d) (2 ^ (d + 1)) P). pose proof (Z.mul_succ_div_gt (x + 2 ^ d) (2 ^ (d + 1)) P).
    set (y := (x + 2 ^ d) / 2 ^ (d + 1)) in *. set (D := 2 ^ (d + 1)) in *. rewrite Q'.
    assert (- 2 ^ (width o - 2) - 1 <= y <= 2 ^ (width o - 2)) by nia. lia.
  - destruct (Z.leb_spec (2 ^ (width o - 1)) (Z.abs (round x d))) as [H|H]; [|lia]. exfalso.
    enough (existsb (fun x => 2 ^ (width o - 1) <=? Z.abs (round x d)) xs = true) by congruence.
    apply existsb_exists. exists x. split; auto. now apply Z.leb_le.
Qed.
Lemma dropped_least o xs : least o <= dropped o xs.
Proof. unfold dropped. destruct (existsb _ _); lia. Qed.

(** [error] bounds the error of a difference. *)
Lemma coordinate_error o d l x true error : 0 <= d -> fine o <= greatest o + 1 -> 0 <= greatest o -> level_of o d <= l ->
  (8 * error <= IZR (2 ^ fine o))%R -> (8 * error <= 4 + IZR (2 ^ greatest o))%R -> (Rabs (IZR x - true) <= error)%R ->
  (Rabs (IZR (round x d) - true / IZR (2 ^ d)) <= eps l)%R.
Proof.
  intros Hd Hf Hg Hl E1 E2 E. unfold level_of in Hl.
  assert (PL : 0 < 2 ^ l) by (apply Z.pow_pos_nonneg; lia). apply IZR_lt in PL. unfold eps.
  destruct (Z.eq_dec d 0) as [->|Nd].
  - assert (round x 0 = x) as -> by (unfold round; change (2 ^ 0) with 1; change (1 / 2) with 0; rewrite Z.div_1_r; lia).
    change (IZR (2 ^ 0)) with 1%R. unfold Rdiv. rewrite Rinv_1, Rmult_1_r.
    destruct (Z.le_gt_cases (fine o) (greatest o)) as [C|C].
    + assert (M : 2 ^ fine o <= 2 ^ l).
      { destruct (Z.lt_ge_cases (fine o) 0) as [C'|C']; [rewrite (Z.pow_neg_r _ _ C'); lia || (apply lt_IZR in PL; lia)|apply Z.pow_le_mono_r; lia]. }
      apply IZR_le in M. lra.
    + assert (M : 2 ^ greatest o <= 2 ^ l) by (apply Z.pow_le_mono_r; lia). apply IZR_le in M. lra.
  - pose proof (round_error x d Hd) as K.
    assert (PD : 0 < 2 ^ d) by (apply Z.pow_pos_nonneg; lia). apply IZR_lt in PD.
    assert (M : 2 ^ fine o <= 2 ^ l * 2 ^ d).
    { rewrite <- Z.pow_add_r by lia. destruct (Z.lt_ge_cases (fine o) 0) as [C'|C']; [rewrite (Z.pow_neg_r _ _ C'); apply Z.pow_nonneg; lia|apply Z.pow_le_mono_r; lia]. }
    apply IZR_le in M. rewrite mult_IZR in M. set (D := IZR (2 ^ d)) in *. set (q := IZR (round x d)) in *.
    assert (T : (Rabs (q * D - true) <= D / 2 + error)%R).
    { replace (q * D - true)%R with ((q * D - IZR x) + (IZR x - true))%R by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
    assert (U : (Rabs (q - true / D) * D <= D / 2 + error)%R).
    { rewrite <- (Rabs_pos_eq D) at 2 by lra. rewrite <- Rabs_mult. replace ((q - true / D) * D)%R with (q * D - true)%R by (field; lra). exact T. }
    apply (Rmult_le_reg_r D); auto. nra.
Qed.

(** * Section 6 *)
Definition there (v : vec) : R.S.vec := R.S.V3 (X v) (Y v) (Z_ v).
Lemma to_sign_certain s number bound true : 0 <= s -> near s number bound true ->
  to_sign (certain_sign number bound) = O \/ to_sign (certain_sign number bound) = RealNumbers.sg true.
Proof.
  intros Hs K. destruct (sign_certain s number bound true Hs K) as [A B]. unfold to_sign.
  destruct (Z.eqb_spec (certain_sign number bound) 1) as [E|E].
  - right. symmetry. apply RealNumbers.sg_P. apply A in E. lra.
  - destruct (Z.eqb_spec (certain_sign number bound) (-1)) as [F|F]; [|now left].
    right. symmetry. apply RealNumbers.sg_N. apply B in F. lra.
Qed.
Lemma signs_are_certain s numbers bounds true : 0 <= s -> Forall2 (fun number true => near s (fst number) (snd number) true) (combine numbers bounds) true ->
  certain (sign_at (map (fun p => to_sign (certain_sign (fst p) (snd p))) (combine numbers bounds))) (fun v => RealNumbers.sg (nth (place v) true 0%R)).
Proof.
  intros Hs H v. unfold sign_at. generalize (place v) as i. induction H as [|p u ps us K H IH]; intros [|i]; cbn; auto.
  now apply (to_sign_certain s).
Qed.

Module RV := OnReals.
Lemma boxes_right l x (y1 y2 : vec) (y : three -> vec) : 0 <= l <= 6 ->
  within (eps l) (minus y1 (real (V1 x))) -> within (eps l) (minus y2 (real (V2 x))) -> (forall i, within (eps l) (minus (y i) (real (W x i)))) ->
  boxes_apart (box_gap l) x = true -> ~ R.S.meet R.S.origin (there y1) (there y2) (there (y T0)) (there (y T1)) (there (y T2)).
Proof.
  intros Hl H1 H2 HW E M. apply R.boxes_sound in M.
  assert (G : (2 * eps l < IZR (box_gap l))%R).
  { unfold eps, box_gap. assert (L : l = 0 \/ l = 1 \/ l = 2 \/ l = 3 \/ l = 4 \/ l = 5 \/ l = 6) by lia.
    destruct L as [->|[->|[->|[->|[->|[->| ->]]]]]]; cbn -[IZR]; lra. }
  set (gap := box_gap l) in *. set (e := eps l) in *.
  assert (He : (0 < e)%R) by (unfold e; apply Rlt_trans with (1 / 2)%R; [lra|apply eps_pos; lia]).
  pose proof (HW T0) as HW0. pose proof (HW T1) as HW1. pose proof (HW T2) as HW2. clear HW.
  unfold within, minus, real in *. cbn [X Y Z_] in *.
  unfold boxes_apart in E. cbn [existsb] in E. unfold R.boxes_apart in M. cbn [existsb] in M. rewrite !orb_false_iff in M. rewrite !orb_true_iff in E.
  assert (T : forall a b : R, (0 < b - a)%R -> seq (RealNumbers.sg (RealNumbers.sub b a)) P = true) by (intros; apply seq_eq, RealNumbers.sg_P; auto).
  assert (Q : forall a1 a2 b0 b1 b2 r1 r2 s0 s1 s2, (Rabs (r1 - IZR a1) <= e)%R -> (Rabs (r2 - IZR a2) <= e)%R ->
    (Rabs (s0 - IZR b0) <= e)%R -> (Rabs (s1 - IZR b1) <= e)%R -> (Rabs (s2 - IZR b2) <= e)%R ->
    (gap <=? Z.min (Z.min 0 a1) a2 - Z.max (Z.max b0 b1) b2) = true \/ (gap <=? Z.min (Z.min b0 b1) b2 - Z.max (Z.max 0 a1) a2) = true ->
    R.apart [RealNumbers.zero; r1; r2] [s0; s1; s2] = true).
  { clear - T G He. intros a1 a2 b0 b1 b2 r1 r2 s0 s1 s2 K1 K2 L0 L1 L2 H.
    apply Rabs_le_inv in K1, K2, L0, L1, L2. unfold R.apart, R.below. cbn [forallb]. rewrite orb_true_iff, !andb_true_iff.
    assert (I : forall u v : Z, gap <= u - v -> (IZR gap <= IZR u - IZR v)%R) by (intros u v K; apply IZR_le in K; now rewrite minus_IZR in K).
    unfold RealNumbers.zero in *.
    destruct H as [H|H]; apply Z.leb_le in H; [right|left]; repeat split; apply T;
      pose proof (I 0 b0); pose proof (I 0 b1); pose proof (I 0 b2); pose proof (I a1 b0); pose proof (I a1 b1); pose proof (I a1 b2);
      pose proof (I a2 b0); pose proof (I a2 b1); pose proof (I a2 b2); pose proof (I b0 0); pose proof (I b1 0); pose proof (I b2 0);
      pose proof (I b0 a1); pose proof (I b1 a1); pose proof (I b2 a1); pose proof (I b0 a2); pose proof (I b1 a2); pose proof (I b2 a2).
    all: repeat match goal with K : ?p -> _ |- _ => match p with ?g <= _ => first [assert (p) as KK by lia; specialize (K KK); clear KK|clear K] end end; lra. }
  destruct H1 as (A1 & A2 & A3), H2 as (B1 & B2 & B3), HW0 as (C1 & C2 & C3), HW1 as (D1 & D2 & D3), HW2 as (E1 & E2 & E3).
  destruct M as (M1 & M2 & M3 & _). cbn -[R.apart] in M1, M2, M3.
  destruct E as [E|[E|[E|E]]]; [..|discriminate];
    [exact (eq_true_false_abs _ (Q _ _ _ _ _ _ _ _ _ _ A1 B1 C1 D1 E1 E) M1)|exact (eq_true_false_abs _ (Q _ _ _ _ _ _ _ _ _ _ A2 B2 C2 D2 E2 E) M2)
    |exact (eq_true_false_abs _ (Q _ _ _ _ _ _ _ _ _ _ A3 B3 C3 D3 E3 E) M3)].
Qed.

(** From differences, each wrong by at most [error], to the verdict. *)
Definition says (a : answer) (meets : Prop) : Prop := (a = Separate -> ~ meets) /\ (a = Intersect -> meets).
Theorem differences_right o x (t1 t2 : vec) (tw : three -> vec) error : valid o = true ->
  (8 * error <= IZR (2 ^ fine o))%R -> (8 * error <= 4 + IZR (2 ^ greatest o))%R ->
  close error (V1 x) t1 -> close error (V2 x) t2 -> (forall l, close error (W x l) (tw l)) ->
  says (verdict (outcome_of (of_differences o x))) (R.S.meet R.S.origin (there t1) (there t2) (there (tw T0)) (there (tw T1)) (there (tw T2))).
Proof.
  intros V E1 E2 C1 C2 CW. assert (V' := V). unfold valid in V'. rewrite !andb_true_iff, !Z.leb_le in V'.
  destruct V' as [[[[[[[[[V1' V2'] V3'] V4'] V5'] V6'] V7'] V8'] V9'] V10'].
  set (y := coordinates_of o x). set (l := level y).
  assert (PD : forall xs, 0 <= dropped o xs) by (intros; pose proof (dropped_least o xs); lia).
  assert (Hl : 0 <= l <= 6) by (unfold l, y, coordinates_of, level, level_of; lia).
  set (kx := (/ IZR (2 ^ dx y))%R). set (ky := (/ IZR (2 ^ dy y))%R). set (kz := (/ IZR (2 ^ dz y))%R).
  assert (PK : forall xs, (0 < / IZR (2 ^ dropped o xs))%R) by (intros xs; apply Rinv_0_lt_compat, IZR_lt, Z.pow_pos_nonneg; auto; lia).
  assert (KX : (0 < kx)%R) by apply PK. assert (KY : (0 < ky)%R) by apply PK. assert (KZ : (0 < kz)%R) by apply PK.
  (* The true points in the scale of the coordinates. *)
  set (to := fun v : vec => V3 (kx * X v) (ky * Y v) (kz * Z_ v)).
  assert (S : R.S.meet R.S.origin (there t1) (there t2) (there (tw T0)) (there (tw T1)) (there (tw T2)) <->
    R.S.meet R.S.origin (there (to t1)) (there (to t2)) (there (to (tw T0))) (there (to (tw T1))) (there (to (tw T2)))).
  { rewrite <- (meet_stretched kx ky kz) by lra. replace (stretched kx ky kz R.S.origin) with R.S.origin; [reflexivity|].
    unfold stretched, R.S.origin, RealNumbers.zero; cbn. f_equal; ring. }
  assert (W' : forall u v, close error u v -> (forall c, c = ZX \/ c = ZY \/ c = ZZ -> True) ->
    within (eps l) (minus (to v) (real (Z3 (round (ZX u) (dx y)) (round (ZY u) (dy y)) (round (ZZ u) (dz y)))))).
  { intros u v (A & B & C) _. unfold within, minus, to, real; cbn [X Y Z_ ZX ZY ZZ]. rewrite !(Rabs_minus_sym (_ * _)).
    rewrite (Rmult_comm kx), (Rmult_comm ky), (Rmult_comm kz).
    repeat split; (eapply coordinate_error; eauto; [apply PD|unfold l, y, coordinates_of, level; cbn; lia]). }
  pose proof (W' _ _ C1 ltac:(auto)) as W1. pose proof (W' _ _ C2 ltac:(auto)) as W2.
  assert (WW : forall i, within (eps l) (minus (to (tw i)) (real (W (at_ y) i)))).
  { intros i. unfold y, coordinates_of; cbn -[tab]. rewrite get_tab. apply (W' _ _ (CW i)). auto. }
  change (within (eps l) (minus (to t1) (real (V1 (at_ y))))) in W1. change (within (eps l) (minus (to t2) (real (V2 (at_ y))))) in W2.
  assert (F : forall v, In v [V1 x; V2 x; W x T0; W x T1; W x T2] -> fits (width o) (Z3 (round (ZX v) (dx y)) (round (ZY v) (dy y)) (round (ZZ v) (dz y)))).
  { intros v I. unfold fits; cbn [ZX ZY ZZ].
    repeat split; apply dropped_fits; auto; apply (in_map _ _ _ I). }
  assert (F1 : fits (width o) (V1 (at_ y))) by (apply F; cbn; auto). assert (F2 : fits (width o) (V2 (at_ y))) by (apply F; cbn; auto).
  assert (FW : forall i, fits (width o) (W (at_ y) i)) by (intros []; apply F; cbn [In]; auto 8).
  set (s := shift_of o (exact_moments (at_ y))).
  assert (Hs : 0 <= s <= width o).
  { assert (T : forall k r s0, s0 <= shift_from k (width o) r s0 <= s0 + Z.of_nat k).
    { induction k; intros r s0; cbn [shift_from]; [lia|]. rewrite Nat2Z.inj_succ. destruct (fits_shift (width o) r s0); [lia|]. specialize (IHk r (s0 + 1)). lia. }
    pose proof (T (Z.to_nat (span o)) (exact_moments (at_ y)) (width o - span o)). unfold s, shift_of. lia. }
  pose proof (errors (bound o) (width o) s l V1' Hs Hl (at_ y) F1 F2 FW _ _ (fun i => minus (to (tw i)) (real (W (at_ y) i))) W1 W2 WW) as K. cbv zeta beta in K.
  assert (E0 : forall u v, plus u (minus v u) = v) by (intros [] []; unfold plus, minus; cbn; f_equal; ring).
  rewrite !E0 in K. set (r' := rounded s (exact_moments (at_ y))) in *.
  apply signs_are_certain in K; [|lia].
  set (signs := map _ (combine (all_of (numbers (at_ y) r')) (all_of (bounds (bound o) (width o) s l (at_ y) r')))) in K.
  set (f := fun v => RealNumbers.sg (nth (place v) (true_fifteen (to t1) (to t2) (to (tw T0)) (to (tw T1)) (to (tw T2))) 0%R)) in K.
  assert (K' : certain (sign_at signs) (R.S.sign_of (R.S.fifteen (there (to t1)) (there (to t2)) (there (to (tw T0))) (there (to (tw T1))) (there (to (tw T2)))))) by exact K.
  assert (O' : outcome_of (of_differences o x) = decided (boxes o && boxes_apart (box_gap l) (at_ y)) signs) by reflexivity.
  rewrite O'. unfold says. rewrite S. clear O' K S.
  unfold decided. cbn [verdict].
  assert (FL : length (filter (fun b => b) (map (at_edge misses (sign_at signs)) edge_list)) = length (filter (at_edge misses (sign_at signs)) edge_list)).
  { generalize edge_list. intros es. induction es as [|e es IH]; [reflexivity|]. cbn [map filter]. destruct (at_edge misses (sign_at signs) e); cbn [length]; now rewrite IH. }
  rewrite FL.
  destruct (boxes o && boxes_apart (box_gap l) (at_ y)) eqn:BX.
  - cbn [orb]. split; [|discriminate]. intros _. apply andb_true_iff in BX as [_ BX]. exact (boxes_right l (at_ y) _ _ (fun i => to (tw i)) Hl W1 W2 WW BX).
  - cbn [orb]. destruct (one_side (sign_at signs) [1; 2; 3]%positive || one_side (sign_at signs) [4; 5; 6]%positive || Nat.leb 5 _) eqn:SEP.
    + split; [|discriminate]. intros _. exact (RV.separate_sound _ _ _ _ _ _ K' SEP).
    + destruct (existsb (fun b => b) _) eqn:PI; [|split; discriminate]. split; [discriminate|]. intros _.
      apply (RV.intersect_sound _ _ _ _ _ _ K'). unfold says_intersect, says_separate. rewrite SEP. cbn [negb andb].
      apply existsb_exists in PI as (b & I & ->). apply in_map_iff in I as (e & H & I). apply existsb_exists. eauto.
Qed.

(** * Section 2: differences *)
Definition floor_of (w : Z) (r : R) : Prop := (IZR w <= r < IZR w + 1)%R.
Definition floors (w : zvec) (v : vec) : Prop := floor_of (ZX w) (X v) /\ floor_of (ZY w) (Y v) /\ floor_of (ZZ w) (Z_ v).
(** Within the declared range of a coordinate, or of an entry of M. *)
Definition declared f (v : vec) : Prop := within (IZR (2 ^ f)) v.

Lemma part_error q x y : 0 < q -> Z.odd x = true -> Z.odd y = true -> 1 <= (x mod 2 ^ q) * (y mod 2 ^ q) <= 2 ^ (2 * q) - 1.
Proof.
  intros Hq Ox Oy. assert (P : 0 < 2 ^ q) by (apply Z.pow_pos_nonneg; lia).
  assert (Q : 2 ^ (2 * q) = 2 ^ q * 2 ^ q) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
  assert (T : forall x, Z.odd x = true -> 1 <= x mod 2 ^ q <= 2 ^ q - 1).
  { intros z Oz. pose proof (Z.mod_pos_bound z _ P). enough (z mod 2 ^ q <> 0) by lia. intros E.
    apply Z.mod_divide in E; [|lia]. destruct E as [k E]. rewrite E in Oz. replace q with (Z.succ (q - 1)) in Oz by lia.
    rewrite Z.pow_succ_r, Z.mul_assoc, (Z.mul_comm k 2), <- Z.mul_assoc, Z.odd_mul in Oz by lia. discriminate. }
  pose proof (T _ Ox). pose proof (T _ Oy). nia.
Qed.
Lemma odd_middle z : Z.odd (2 * z + 1) = true.
Proof. rewrite Z.odd_add, Z.odd_mul. reflexivity. Qed.
Lemma row_error f v w (mv bv : vec) : 2 <= f -> floors v mv -> floors w bv -> declared f mv -> declared f bv ->
  (Rabs (IZR (row f (middle v) (middle w)) - dot mv bv / IZR (2 ^ f)) <= 4)%R.
Proof.
  intros Hf (M1 & M2 & M3) (B1 & B2 & B3) (DM1 & DM2 & DM3) (DB1 & DB2 & DB3).
  set (q := left_out f).
  assert (Hq : q = 0 \/ (0 < q /\ 2 * q <= f)).
  { unfold q, left_out. destruct (Z.leb_spec (2 * Z.max (f + 3 - 18) 0) f); lia. }
  assert (Bq : q <> 0 -> 16 <= f) by (unfold q, left_out; destruct (Z.leb_spec (2 * Z.max (f + 3 - 18) 0) f); lia).
  assert (F2 : 2 ^ (f + 2) = 4 * 2 ^ f) by (rewrite Z.pow_add_r by lia; lia).
  assert (F1 : 2 ^ (f + 1) = 2 * 2 ^ f) by (rewrite Z.pow_add_r by lia; lia).
  assert (PF : 4 <= 2 ^ f) by (change 4 with (2 ^ 2); apply Z.pow_le_mono_r; lia).
  set (vx := 2 * ZX v + 1). set (vy := 2 * ZY v + 1). set (vz := 2 * ZZ v + 1).
  set (wx := 2 * ZX w + 1). set (wy := 2 * ZY w + 1). set (wz := 2 * ZZ w + 1).
  set (all := vx * wx + vy * wy + vz * wz).
  set (rowsum := (vx * wx - (vx mod 2 ^ q) * (wx mod 2 ^ q)) + (vy * wy - (vy mod 2 ^ q) * (wy mod 2 ^ q)) + (vz * wz - (vz mod 2 ^ q) * (wz mod 2 ^ q))
    + (if q =? 0 then 0 else 3 * 2 ^ (2 * q - 1))).
  (* The products left out. *)
  assert (L : 2 * Z.abs (rowsum - all) <= if q =? 0 then 0 else 3 * 2 ^ f).
  { unfold rowsum, all. destruct (Z.eqb_spec q 0) as [->|Nq].
    - change (2 ^ 0) with 1. rewrite !Z.mod_1_r. lia.
    - destruct Hq as [Hq|[Hq1 Hq2]]; [lia|].
      pose proof (part_error q vx wx Hq1 (odd_middle _) (odd_middle _)). pose proof (part_error q vy wy Hq1 (odd_middle _) (odd_middle _)). pose proof (part_error q vz wz Hq1 (odd_middle _) (odd_middle _)).
      assert (2 ^ (2 * q) = 2 * 2 ^ (2 * q - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
      assert (2 ^ (2 * q) <= 2 ^ f) by (apply Z.pow_le_mono_r; lia). lia. }
  assert (R0 : row f (middle v) (middle w) = (rowsum + 2 ^ (f + 1)) / 2 ^ (f + 2)) by (unfold row; cbv zeta; fold q; reflexivity).
  rewrite R0. set (y := (rowsum + 2 ^ (f + 1)) / 2 ^ (f + 2)).
  assert (Y0 : 2 * Z.abs (y * (4 * 2 ^ f) - rowsum) <= 4 * 2 ^ f).
  { pose proof (Z.mul_div_le (rowsum + 2 ^ (f + 1)) (2 ^ (f + 2)) ltac:(lia)). pose proof (Z.mul_succ_div_gt (rowsum + 2 ^ (f + 1)) (2 ^ (f + 2)) ltac:(lia)).
    fold y in H, H0. rewrite F1, F2 in *. lia. }
  (* Midpoints. *)
  unfold declared, within, floor_of in *. set (E := IZR (2 ^ f)) in *.
  assert (PE : (4 <= E)%R) by (apply (IZR_le 4); lia).
  assert (T : forall a b ra rb, (IZR a <= ra < IZR a + 1)%R -> (IZR b <= rb < IZR b + 1)%R -> (Rabs ra <= E)%R -> (Rabs rb <= E)%R ->
    (Rabs (IZR ((2 * a + 1) * (2 * b + 1)) - 4 * (ra * rb)) <= 4 * E + 1)%R).
  { intros a b ra rb Ha Hb Da Db. rewrite mult_IZR, !plus_IZR, !mult_IZR. set (ma := (2 * IZR a + 1)%R). set (mb := (2 * IZR b + 1)%R).
    assert (Na : (Rabs (ma - 2 * ra) <= 1)%R) by (apply Rabs_le; unfold ma; lra). assert (Nb : (Rabs (mb - 2 * rb) <= 1)%R) by (apply Rabs_le; unfold mb; lra).
    replace (ma * mb - 4 * (ra * rb))%R with ((ma - 2 * ra) * (2 * rb) + (mb - 2 * rb) * (2 * ra) + (ma - 2 * ra) * (mb - 2 * rb))%R by ring.
    eapply Rle_trans; [apply Rabs_triang|]. pose proof (Rabs_triang ((ma - 2 * ra) * (2 * rb)) ((mb - 2 * rb) * (2 * ra))).
    rewrite !Rabs_mult, (Rabs_pos_eq 2) in * by lra.
    pose proof (Rabs_pos ra). pose proof (Rabs_pos rb). pose proof (Rabs_pos (ma - 2 * ra)). pose proof (Rabs_pos (mb - 2 * rb)). nra. }
  pose proof (T _ _ _ _ M1 B1 DM1 DB1) as T1. pose proof (T _ _ _ _ M2 B2 DM2 DB2) as T2. pose proof (T _ _ _ _ M3 B3 DM3 DB3) as T3.
  assert (Q : (Rabs (IZR all - 4 * dot mv bv) <= 12 * E + 3)%R).
  { unfold all, dot. rewrite !plus_IZR. fold vx vy vz wx wy wz in T1, T2, T3.
    match goal with |- (Rabs ?e <= _)%R => match type of T1 with (Rabs ?a <= _)%R => match type of T2 with (Rabs ?b <= _)%R => match type of T3 with (Rabs ?c <= _)%R =>
      replace e with (a + b + c)%R by ring end end end end.
    eapply Rle_trans; [apply Rabs_triang|]. match goal with |- (Rabs (?a + ?b) + _ <= _)%R => pose proof (Rabs_triang a b) end. lra. }
  assert (L' : (2 * Rabs (IZR rowsum - IZR all) <= if q =? 0 then 0 else 3 * E)%R).
  { apply IZR_le in L. rewrite mult_IZR, abs_IZR, minus_IZR in L. destruct (q =? 0); [exact L|]. rewrite mult_IZR in L. exact L. }
  assert (Y' : (2 * Rabs (IZR y * (4 * E) - IZR rowsum) <= 4 * E)%R).
  { apply IZR_le in Y0. rewrite mult_IZR, abs_IZR, minus_IZR, !mult_IZR in Y0. exact Y0. }
  assert (G : (Rabs (IZR y * (4 * E) - 4 * dot mv bv) <= 2 * E + (if q =? 0 then 0 else 3 / 2 * E) + (12 * E + 3))%R).
  { replace (IZR y * (4 * E) - 4 * dot mv bv)%R with ((IZR y * (4 * E) - IZR rowsum) + (IZR rowsum - IZR all) + (IZR all - 4 * dot mv bv))%R by ring.
    eapply Rle_trans; [apply Rabs_triang|]. match goal with |- (Rabs (?a + ?b) + _ <= _)%R => pose proof (Rabs_triang a b) end. destruct (q =? 0); lra. }
  assert (Big : (if q =? 0 then True else 65536 <= E)%R).
  { destruct (Z.eqb_spec q 0) as [|Nq]; auto. apply (IZR_le 65536). change 65536 with (2 ^ 16). apply Z.pow_le_mono_r; lia. }
  apply (Rmult_le_reg_r (4 * E)); [lra|]. rewrite <- (Rabs_pos_eq (4 * E)) at 1 by lra. rewrite <- Rabs_mult.
  replace ((IZR y - dot mv bv / E) * (4 * E))%R with (IZR y * (4 * E) - 4 * dot mv bv)%R by (field; lra).
  eapply Rle_trans; [exact G|]. destruct (q =? 0); lra.
Qed.

(** * The theorem *)
(** The user's numbers, in ulps of the input format: two triangles, and the pose. *)
Record truth := Truth { TA : three -> vec; TB : three -> vec; TM : three -> vec; Tt : vec }.
Definition true_placed o i u l : vec := match moves o, bypass i with
  | Off, _ | _, true => TB u l
  | Translate, _ => plus (TB u l) (Tt u)
  | On, _ => let r j := (dot (TM u j) (TB u l) / IZR (2 ^ fraction o))%R in plus (V3 (r T0) (r T1) (r T2)) (Tt u) end.
Definition stands_for o i u : Prop :=
  (forall k, floors (A i k) (TA u k)) /\ (forall k, floors (B i k) (TB u k)) /\ (forall k, floors (M i k) (TM u k)) /\ floors (t i) (Tt u) /\
  (moves o = On -> forall k, declared (fraction o) (TB u k) /\ declared (fraction o) (TM u k)).
Definition place_of (v : vec) : point := (X v, Y v, Z_ v).

Lemma floor_difference a b x y : floor_of a x -> floor_of b y -> (Rabs (IZR (a - b) - (x - y)) <= 1)%R.
Proof. unfold floor_of. rewrite minus_IZR. intros. apply Rabs_le. lra. Qed.
Lemma floors_difference u v x y : floors u x -> floors v y -> close 1 (zminus u v) (minus x y).
Proof. intros (A1 & A2 & A3) (B1 & B2 & B3). unfold close, zminus, minus; cbn. repeat split; now apply floor_difference. Qed.

Theorem determinant_unit_is_right o i u : valid o = true -> stands_for o i u ->
  says (verdict (unit o i)) (common (place_of (TA u T0)) (place_of (TA u T1)) (place_of (TA u T2))
    (place_of (true_placed o i u T0)) (place_of (true_placed o i u T1)) (place_of (true_placed o i u T2))).
Proof.
  intros V (FA & FB & FM & Ft & D). assert (V' := V). unfold valid in V'. rewrite !andb_true_iff, !Z.leb_le in V'.
  destruct V' as [[[[[[[[[V1' V2'] V3'] V4'] V5'] V6'] V7'] V8'] V9'] V10'].
  set (err := difference_error (moves o)) in *.
  assert (H : says (verdict (unit o i)) (R.S.meet R.S.origin (there (minus (TA u T1) (TA u T0))) (there (minus (TA u T2) (TA u T0)))
    (there (minus (true_placed o i u T0) (TA u T0))) (there (minus (true_placed o i u T1) (TA u T0))) (there (minus (true_placed o i u T2) (TA u T0))))).
  { apply (differences_right o (differences o i) _ _ (fun l => minus (true_placed o i u l) (TA u T0)) (IZR err)); auto.
    - rewrite <- mult_IZR. apply IZR_le. exact V7'.
    - rewrite <- mult_IZR, <- plus_IZR. apply IZR_le. exact V8'.
    - assert (1 <= err) as K by (unfold err; destruct (moves o); cbn; lia). apply IZR_le in K.
      destruct (floors_difference _ _ _ _ (FA T1) (FA T0)) as (K1 & K2 & K3). repeat split; eapply Rle_trans; eauto.
    - assert (1 <= err) as K by (unfold err; destruct (moves o); cbn; lia). apply IZR_le in K.
      destruct (floors_difference _ _ _ _ (FA T2) (FA T0)) as (K1 & K2 & K3). repeat split; eapply Rle_trans; eauto.
    - intros l. cbn [differences W]. rewrite get_tab. unfold placed, true_placed.
      assert (S1 : close 1 (zminus (B i l) (A i T0)) (minus (TB u l) (TA u T0))) by (apply floors_difference; auto).
      assert (Sle : forall e e' a b, (e <= e')%R -> close e a b -> close e' a b) by (intros e e' a b L (K1 & K2 & K3); repeat split; eapply Rle_trans; eauto).
      unfold err. destruct (moves o) eqn:MO; [exact S1| |].
      + destruct (bypass i); [apply (Sle 1%R); [cbn; lra|exact S1]|].
        destruct (FB l) as (B1 & B2 & B3), (FA T0) as (A1 & A2 & A3), Ft as (U1 & U2 & U3). unfold floor_of in *.
        unfold close, zminus, zplus, minus, plus; cbn. rewrite !minus_IZR, !plus_IZR. repeat split; apply Rabs_le; lra.
      + destruct (bypass i); [apply (Sle 1%R); [cbn; lra|exact S1]|]. specialize (D eq_refl).
        destruct (FA T0) as (A1 & A2 & A3), Ft as (U1 & U2 & U3). unfold floor_of in *.
        assert (Q : forall j, (Rabs (IZR (row (fraction o) (middle (M i j)) (middle (B i l))) - dot (TM u j) (TB u l) / IZR (2 ^ fraction o)) <= 4)%R).
        { intros j. apply row_error; auto; apply D. }
        pose proof (Rabs_le_inv _ _ (Q T0)). pose proof (Rabs_le_inv _ _ (Q T1)). pose proof (Rabs_le_inv _ _ (Q T2)).
        unfold close, zminus, zplus, minus, plus; cbn -[row]. rewrite !minus_IZR, !plus_IZR. repeat split; apply Rabs_le; lra. }
  assert (E : forall P Q a, (P <-> Q) -> says a P -> says a Q) by (unfold says; tauto).
  revert H. apply E. rewrite <- (meet_common (there (TA u T0)) (there (TA u T1)) (there (TA u T2)) (there (true_placed o i u T0)) (there (true_placed o i u T1)) (there (true_placed o i u T2))).
  symmetry. apply R.S.meet_shift.
Qed.
