(** Six points in space: a common point of two closed triangles, by weights, and the fifteen determinants.

    A common point makes an edge hit, unless all fifteen determinants are 0 ([common_hits]); an edge that hits gives a common point
    ([hits_common]). Section 7 of docs/exact.md, pairs that are not in one plane. *)
From Coq Require Import List Bool PArith ZArith Ring.
Require Import Efsat.Sign Efsat.Domain Efsat.Table.
Import ListNotations.

Module Space (D : DOM).
  Module F := Facts D.
  Import D F.
  Local Open Scope dom.

  Record vec := V3 { X : C; Y : C; Z : C }.
  Definition minus u v := V3 (X u - X v) (Y u - Y v) (Z u - Z v).
  Definition cross u v := V3 (Y u * Z v - Z u * Y v) (Z u * X v - X u * Z v) (X u * Y v - Y u * X v).
  Definition dot u v := X u * X v + Y u * Y v + Z u * Z v.
  Definition combine (x y z : C) (u v w : vec) :=
    V3 (x * X u + y * X v + z * X w) (x * Y u + y * Y v + z * Y w) (x * Z u + y * Z v + z * Z w).
  Definition origin := V3 0 0 0.

  (** Homogeneous weights of a common point of A and B. *)
  Definition meets_at v0 v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 : Prop :=
    combine x0 x1 x2 v0 v1 v2 = combine x3 x4 x5 w0 w1 w2 /\ x0 + x1 + x2 = x3 + x4 + x5 /\
    Forall (fun x => sg x <> N) [x0; x1; x2; x3; x4; x5] /\ sg (x0 + x1 + x2) = P.
  Definition meet v0 v1 v2 w0 w1 w2 : Prop := exists x0 x1 x2 x3 x4 x5, meets_at v0 v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5.

  Lemma meet_shift v0 v1 v2 w0 w1 w2 :
    meet v0 v1 v2 w0 w1 w2 <-> meet origin (minus v1 v0) (minus v2 v0) (minus w0 v0) (minus w1 v0) (minus w2 v0).
  Proof.
    split; intros (x0 & x1 & x2 & x3 & x4 & x5 & E & S & G & K); exists x0, x1, x2, x3, x4, x5; repeat split; auto;
    destruct v0, v1, v2, w0, w1, w2; unfold combine, minus, origin in *; cbn in *; injection E as E1 E2 E3;
    assert (S0 : x0 = x3 + x4 + x5 - x1 - x2) by (rewrite <- S; ring); clear S K G.
    - f_equal; [transitivity ((x0 * X0 + x1 * X1 + x2 * X2) - (x0 + x1 + x2) * X0)|
        transitivity ((x0 * Y0 + x1 * Y1 + x2 * Y2) - (x0 + x1 + x2) * Y0)|
        transitivity ((x0 * Z0 + x1 * Z1 + x2 * Z2) - (x0 + x1 + x2) * Z0)]; try ring; rewrite ?E1, ?E2, ?E3, S0; ring.
    - f_equal; [transitivity ((x0 * 0 + x1 * (X1 - X0) + x2 * (X2 - X0)) + (x0 + x1 + x2) * X0)|
        transitivity ((x0 * 0 + x1 * (Y1 - Y0) + x2 * (Y2 - Y0)) + (x0 + x1 + x2) * Y0)|
        transitivity ((x0 * 0 + x1 * (Z1 - Z0) + x2 * (Z2 - Z0)) + (x0 + x1 + x2) * Z0)]; try ring; rewrite ?E1, ?E2, ?E3, S0; ring.
  Qed.

  Section Pair.
    Variables v1 v2 w0 w1 w2 : vec.
    Let n := cross v1 v2. Let m0 := cross w0 w1. Let m1 := cross w1 w2. Let m2 := cross w2 w0.
    Let a0 := dot n w0. Let a1 := dot n w1. Let a2 := dot n w2.
    Let d10 := dot v1 m0. Let d11 := dot v1 m1. Let d12 := dot v1 m2.
    Let d20 := dot v2 m0. Let d21 := dot v2 m1. Let d22 := dot v2 m2.
    Let e := dot w0 m1.
    (** In the order of the table. *)
    Definition fifteen : list C :=
      [a0; a1; a2; e; e - (d10 + d11 + d12); e - (d20 + d21 + d22);
       - d10; - d11; - d12; d10 - d20 + a0 - a1; d11 - d21 + a1 - a2; d12 - d22 + a2 - a0; d20; d21; d22].
  End Pair.
  Definition pick (l : list C) (v : positive) : C := nth (place v) l 0.
  Definition sign_of l v := sg (pick l v).

  Section Weights.
    Variables v1 v2 w0 w1 w2 : vec.
    Variables x0 x1 x2 x3 x4 x5 : C.
    Hypothesis M : meets_at origin v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5.

    Definition value (f : vec) (c : C) : C :=
      x0 * c + x1 * (dot f v1 + c) + x2 * (dot f v2 + c) - (x3 * (dot f w0 + c) + x4 * (dot f w1 + c) + x5 * (dot f w2 + c)).
    Lemma functional f c : value f c = 0.
    Proof.
      unfold value. destruct M as (E & S & _). clear M. destruct v1, v2, w0, w1, w2, f. unfold combine, origin, dot in *; cbn in *.
      injection E as E1 E2 E3.
      transitivity (X5 * ((x0 * 0 + x1 * X0 + x2 * X1) - (x3 * X2 + x4 * X3 + x5 * X4)) +
        Y5 * ((x0 * 0 + x1 * Y0 + x2 * Y1) - (x3 * Y2 + x4 * Y3 + x5 * Y4)) +
        Z5 * ((x0 * 0 + x1 * Z0 + x2 * Z1) - (x3 * Z2 + x4 * Z3 + x5 * Z4)) + c * (x0 + x1 + x2 - (x3 + x4 + x5))); [ring|].
      rewrite E1, E2, E3, S. ring.
    Qed.

    Ltac by_plane p q r :=
      let f := constr:(cross (minus q p) (minus r p)) in
      first [transitivity (- value f (- dot f p)); [unfold value, dot, cross, minus, origin; cbn; ring|rewrite functional; ring]
      | transitivity (value f (- dot f p)); [unfold value, dot, cross, minus, origin; cbn; ring|apply functional]].

    Definition all := fifteen v1 v2 w0 w1 w2 ++ [x0; x1; x2; x3; x4; x5].
    Lemma cramer_holds : Forall (zero_sum (pick all)) (map cramer triples).
    Proof.
      let t := eval vm_compute in (map cramer triples) in change (map cramer triples) with t.
      unfold all, fifteen. repeat apply Forall_cons; try apply Forall_nil; cbn -[dot cross].
      - by_plane w0 w1 w2.
      - by_plane v2 w1 w2.
      - by_plane v2 w0 w2.
      - by_plane v2 w0 w1.
      - by_plane v1 w1 w2.
      - by_plane v1 w0 w2.
      - by_plane v1 w0 w1.
      - by_plane v1 v2 w2.
      - by_plane v1 v2 w1.
      - by_plane v1 v2 w0.
      - by_plane origin w1 w2.
      - by_plane origin w0 w2.
      - by_plane origin w0 w1.
      - by_plane origin v2 w2.
      - by_plane origin v2 w1.
      - by_plane origin v2 w0.
      - by_plane origin v1 w2.
      - by_plane origin v1 w1.
      - by_plane origin v1 w0.
      - by_plane origin v1 v2.
    Qed.
  End Weights.

  (** An edge hits, by the signs of some numbers. *)
  Definition hits_edge (f : positive -> sign) (e : bool * (positive * positive * positive * positive * positive)) : bool :=
    let '(_, (p, q, s0, s1, s2)) := e in hits (f p) (f q) (f s0) (f s1) (f s2).
  Lemma hit_list_hits f es x : In x (hit_list es) -> holds f x = true -> existsb (hits_edge f) es = true.
  Proof.
    unfold hit_list. rewrite in_flat_map. intros ((b & [[[[p q] s0] s1] s2]) & I & J) H.
    apply existsb_exists. exists (b, (p, q, s0, s1, s2)). split; [exact I|]. cbn. eapply hit_patterns_hit; eauto.
  Qed.

  (** The sum of the sides of an edge. *)
  Definition edge_sum (l : list C) (e : bool * (positive * positive * positive * positive * positive)) : Prop :=
    let '(b, (p, q, s0, s1, s2)) := e in
    let sides := pick l s0 + pick l s1 + pick l s2 in pick l q - pick l p = if b then - sides else sides.
  Lemma edge_sums v1 v2 w0 w1 w2 r : Forall (edge_sum (fifteen v1 v2 w0 w1 w2 ++ r)) edge_list.
  Proof.
    unfold edge_list, fifteen. repeat apply Forall_cons; try apply Forall_nil; cbn -[dot cross]; ring.
  Qed.
  Lemma no_sum_pattern l x : Forall (edge_sum l) edge_list -> In x sum_list -> holds (sign_of l) x = true -> False.
  Proof.
    unfold sum_list. rewrite Forall_forall, in_flat_map. intros A ((b & [[[[p q] s0] s1] s2]) & I & J) H.
    specialize (A _ I). cbn in A. unfold sign_of in H.
    assert (K : sg (pick l p) = O -> sg (pick l q) = O -> balanced (sg (pick l s0)) (sg (pick l s1)) (sg (pick l s2)) = true).
    { rewrite !sg_zero. intros E E'. rewrite E, E' in A. apply sum3. destruct b.
      - transitivity (- - (pick l s0 + pick l s1 + pick l s2)); [ring|]. rewrite <- A. ring.
      - rewrite <- A. ring. }
    clear A. cbn in J. unfold balanced in K.
    repeat destruct J as [<-|J]; try destruct J; cbn in H;
    destruct (sg (pick l p)), (sg (pick l q)); try discriminate; specialize (K eq_refl eq_refl);
    destruct (sg (pick l s0)), (sg (pick l s1)), (sg (pick l s2)); discriminate.
  Qed.

  Lemma all_zero_holds f vs x : In x (all_zero vs) -> holds f x = true -> Forall (fun v => f v = O) vs.
  Proof.
    intros [<-|[]] H. unfold holds in H. rewrite forallb_forall in H. apply Forall_forall. intros v I.
    specialize (H (v, zer) (in_map _ _ _ I)). cbn in H. now destruct (f v).
  Qed.

  Lemma pick_app l r v : (place v < length l)%nat -> pick (l ++ r) v = pick l v.
  Proof. intros. now apply app_nth1. Qed.

  (** None of the facts is broken by a common point. *)
  Lemma no_fact v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 : meets_at origin v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 ->
    ~ Forall (fun v => sign_of (fifteen v1 v2 w0 w1 w2) v = O) determinants -> forall p, In p facts ->
    holds (sign_of (fifteen v1 v2 w0 w1 w2 ++ [x0; x1; x2; x3; x4; x5])) p = true -> False.
  Proof.
    intros M NZ p I H. set (l := fifteen v1 v2 w0 w1 w2 ++ [x0; x1; x2; x3; x4; x5]) in *.
    unfold facts in I. rewrite !in_app_iff in I. destruct I as [I|[I|[I|[I|I]]]].
    - exact (zero_sums (pick l) _ _ (cramer_holds _ _ _ _ _ _ _ _ _ _ _ M) I H).
    - exact (no_sum_pattern _ _ (edge_sums _ _ _ _ _ _) I H).
    - destruct M as (_ & _ & G & _). cbn in I. unfold sign_of in H.
      repeat rewrite Forall_cons_iff in G. destruct G as (G0 & G1 & G2 & G3 & G4 & G5 & _).
      repeat destruct I as [<-|I]; try destruct I; cbn in H;
      match type of H with context [mem ?s neg] => destruct s eqn:E end; try discriminate; cbn in E; congruence.
    - apply all_zero_holds with (f := sign_of l) in I; auto. unfold weights in I.
      repeat rewrite Forall_cons_iff in I. destruct I as (I0 & I1 & I2 & _).
      destruct M as (_ & _ & _ & K). cbn in I0, I1, I2. apply sg_zero in I0, I1, I2. cbn in I0, I1, I2. rewrite I0, I1, I2 in K.
      replace (0 + 0 + 0) with 0 in K by ring. rewrite sg0 in K. discriminate.
    - apply NZ. apply all_zero_holds with (f := sign_of l) in I; auto.
      unfold determinants in *. repeat rewrite Forall_cons_iff in *.
      repeat (destruct I as [J I]; split; [exact J|]; clear J). constructor.
  Qed.

  (** A common point makes an edge hit, if not all fifteen are 0. *)
  Theorem common_hits v1 v2 w0 w1 w2 : meet origin v1 v2 w0 w1 w2 ->
    ~ Forall (fun v => sign_of (fifteen v1 v2 w0 w1 w2) v = O) determinants ->
    existsb (hits_edge (sign_of (fifteen v1 v2 w0 w1 w2))) edge_list = true.
  Proof.
    intros (x0 & x1 & x2 & x3 & x4 & x5 & M) NZ.
    destruct (refuted_sound _ _ common_refuted (sign_of (fifteen v1 v2 w0 w1 w2 ++ [x0; x1; x2; x3; x4; x5]))) as (p & I & H).
    rewrite in_app_iff in I. destruct I as [I|I]; [exfalso; exact (no_fact _ _ _ _ _ _ _ _ _ _ _ M NZ _ I H)|].
    exact (hit_list_hits _ _ _ I H).
  Qed.

  (** An edge that hits has a common point. *)
  Lemma one_signed p q s0 s1 s2 : q - p = s0 + s1 + s2 -> hits (sg p) (sg q) (sg s0) (sg s1) (sg s2) = true ->
    (Forall (fun x => sg x <> N) [q; - p; s0; s1; s2] /\ sg (q - p) = P) \/
    (Forall (fun x => sg x <> N) [- q; p; - s0; - s1; - s2] /\ sg (p - q) = P).
  Proof.
    intros E H.
    assert (A : sg (q - p) = match sg q, sopp (sg p) with O, s => s | s, O => s | P, P => P | N, N => N | _, _ => sg (q - p) end).
    { rewrite <- sg_opp. replace (q - p) with (q + - p) by ring. rewrite sg_add_cases at 1. destruct (sg q), (sg (- p)); reflexivity. }
    assert (B : balanced (sg s0) (sg s1) (sg s2) = true \/ sg (q - p) <> O).
    { destruct (sg (q - p)) eqn:Z; [right; discriminate|left|right; discriminate]. apply sum3. rewrite <- E. now apply sg_zero. }
    assert (U : Forall (fun x => sg x <> N) [s0; s1; s2] -> sg (q - p) <> N).
    { intros F. rewrite E. destruct (sum_ge _ F) as [G _]. cbn in G. now replace (s0 + s1 + s2) with (s0 + (s1 + (s2 + 0))) by ring. }
    assert (V : Forall (fun x => sg x <> N) [- s0; - s1; - s2] -> sg (q - p) <> P).
    { intros F. destruct (sum_ge _ F) as [G _]. cbn in G. intros K. apply G. 
      replace (- s0 + (- s1 + (- s2 + 0))) with (- (s0 + s1 + s2)) by ring. now rewrite <- E, sg_opp, K. }
    assert (W : sg (p - q) = sopp (sg (q - p))) by (rewrite <- sg_opp; f_equal; ring).
    rewrite W. repeat rewrite Forall_cons_iff in *. rewrite !sg_opp in *.
    destruct (sg p), (sg q), (sg s0), (sg s1), (sg s2); cbn in H; try discriminate; cbn in A, U, V |- *; rewrite ?A in *; cbn;
      try (left; repeat split; (discriminate || constructor)); try (right; repeat split; (discriminate || constructor)); exfalso.
    all: try (apply U; repeat split; (discriminate || constructor)).
    all: try (apply V; repeat split; (discriminate || constructor)).
  Qed.
  Lemma hits_flip p q s0 s1 s2 : hits p q (sopp s0) (sopp s1) (sopp s2) = hits p q s0 s1 s2.
  Proof. destruct p, q, s0, s1, s2; reflexivity. Qed.

  Ltac weigh x0 x1 x2 x3 x4 x5 G K :=
    exists x0, x1, x2, x3, x4, x5; repeat split;
    [unfold combine, origin, dot, cross; cbn; f_equal; ring|unfold dot, cross; cbn; ring|
     repeat rewrite Forall_cons_iff in *; rewrite ?sg0; repeat split; try apply G; try discriminate; constructor
    |rewrite <- K; f_equal; unfold dot, cross; cbn; ring].

  Theorem hits_common v1 v2 w0 w1 w2 :
    existsb (hits_edge (sign_of (fifteen v1 v2 w0 w1 w2))) edge_list = true -> meet origin v1 v2 w0 w1 w2.
  Proof.
    intros H. apply existsb_exists in H as (e & I & H).
    pose proof (edge_sums v1 v2 w0 w1 w2 []) as A. rewrite app_nil_r in A. rewrite Forall_forall in A. specialize (A _ I).
    unfold edge_list in I. cbn [In] in I.
    destruct I as [<-|[<-|[<-|[<-|[<-|[<-|[]]]]]]]; cbn -[dot cross] in A, H; unfold sign_of in H; cbn -[dot cross] in H.
    1-3: destruct (one_signed _ _ _ _ _ A H) as [[G K]|[G K]].
    7-9: rewrite <- hits_flip, <- !sg_opp in H;
      match type of A with _ = - (?a + ?b + ?c) => replace (- (a + b + c)) with (- a + - b + - c) in A by ring end;
      destruct (one_signed _ _ _ _ _ A H) as [[G K]|[G K]].
    all: match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => idtac end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh q p 0 s1 s2 s0 G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh q p 0 s1 s2 s0 G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh 0 q p s1 s2 s0 G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh 0 q p s1 s2 s0 G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh p 0 q s1 s2 s0 G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh p 0 q s1 s2 s0 G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh s1 s2 s0 q p 0 G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh s1 s2 s0 q p 0 G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh s1 s2 s0 0 q p G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh s1 s2 s0 0 q p G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh s1 s2 s0 p 0 q G K end.
    - match type of G with Forall _ [?q; ?p; ?s0; ?s1; ?s2] => weigh s1 s2 s0 p 0 q G K end.
  Qed.

  (** The relations of Gale: what the eleven axes need. *)
  Lemma pluecker_holds v1 v2 w0 w1 w2 : Forall (zero_sum (pick (fifteen v1 v2 w0 w1 w2))) (map pluecker quads).
  Proof.
    let t := eval vm_compute in (map pluecker quads) in change (map pluecker quads) with t.
    unfold fifteen. repeat apply Forall_cons; try apply Forall_nil; cbn; unfold dot, cross; cbn; ring.
  Qed.
End Space.
