(** The rule of the exact unit, sections 4 and 5 of docs/exact.md: `separate` if and only if the two closed triangles have no common
    point, degenerate and coplanar ones included ([exact_right]). *)
From Coq Require Import List Bool PArith ZArith Ring.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.PlaneTable Efsat.Space Efsat.Plane.
Import ListNotations.

Module Exact (D : DOM).
  Module S := Space D.
  Module L := Plane D.
  Import D S.F S.
  Local Open Scope dom.

  Definition zero_vec (v : vec) : bool := seq (sg (X v)) O && seq (sg (Y v)) O && seq (sg (Z v)) O.
  Definition first_of (vs : list vec) : vec := match filter (fun v => negb (zero_vec v)) vs with v :: _ => v | [] => origin end.
  Definition below (a b : list C) : bool := forallb (fun x => forallb (fun y => seq (sg (y - x)) P) b) a.
  Definition apart (a b : list C) : bool := below a b || below b a.

  (** The two coordinates that are left if the points are projected along one. *)
  Definition along_x (v : vec) : L.point := (Y v, Z v).
  Definition along_y (v : vec) : L.point := (Z v, X v).
  Definition along_z (v : vec) : L.point := (X v, Y v).

  Section Rule.
    Variables v1 v2 w0 w1 w2 : vec.
    Definition boxes_apart : bool := existsb (fun c : vec -> C => apart [0; c v1; c v2] [c w0; c w1; c w2]) [X; Y; Z].
    Definition moments : list vec := [cross v1 v2; cross w0 w1; cross w1 w2; cross w2 w0].
    Definition some_moment (c : vec -> C) : bool := existsb (fun m => negb (seq (sg (c m)) O)) moments.
    Definition parted (p : vec -> L.point) : bool :=
      existsb (parts_edge (L.plane_sign (p origin) (p v1) (p v2) (p w0) (p w1) (p w2))) plane_edges.
    Definition in_plane : bool :=
      if some_moment X then parted along_x || boxes_apart else
      if some_moment Y then parted along_y || boxes_apart else
      if some_moment Z then parted along_z || boxes_apart else
      if zero_vec (cross (first_of [v1; v2]) (first_of [w0; w1; w2])) then boxes_apart
      else existsb (fun c : vec -> C => apart [0] [c w0; c w1; c w2]) [X; Y; Z].
    (** The verdict of docs/exact.md. *)
    Definition separate : bool :=
      let f := sign_of (fifteen v1 v2 w0 w1 w2) in
      if forallb (fun v => seq (f v) O) [1; 2; 3; 4; 5; 6]%positive
      then if forallb (fun v => seq (f v) O) [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive then in_plane else true
      else negb (existsb (hits_edge f) edge_list).
  End Rule.
  Definition exact_separate (p0 p1 p2 q0 q1 q2 : vec) : bool :=
    separate (minus p1 p0) (minus p2 p0) (minus q0 p0) (minus q1 p0) (minus q2 p0).

  (** ** Boxes *)
  Lemma below_apart a0 a1 a2 b0 b1 b2 x0 x1 x2 y0 y1 y2 : below [a0; a1; a2] [b0; b1; b2] = true ->
    Forall (fun x => sg x <> N) [x0; x1; x2; y0; y1; y2] -> sg (x0 + x1 + x2) = P -> x0 + x1 + x2 = y0 + y1 + y2 ->
    x0 * a0 + x1 * a1 + x2 * a2 = y0 * b0 + y1 * b1 + y2 * b2 -> False.
  Proof.
    unfold below. cbn. rewrite !andb_true_iff, !seq_eq. intros B G K S E.
    repeat rewrite Forall_cons_iff in G.
    assert (T : forall a, sg (b0 - a) = P -> sg (b1 - a) = P -> sg (b2 - a) = P -> sg (y0 * (b0 - a) + y1 * (b1 - a) + y2 * (b2 - a)) = P).
    { intros. rewrite S in K. apply L.weighted; tauto. }
    assert (U : sg (x0 * (y0 * (b0 - a0) + y1 * (b1 - a0) + y2 * (b2 - a0)) + x1 * (y0 * (b0 - a1) + y1 * (b1 - a1) + y2 * (b2 - a1))
      + x2 * (y0 * (b0 - a2) + y1 * (b1 - a2) + y2 * (b2 - a2))) = P) by (apply L.weighted; try apply T; tauto).
    replace (x0 * (y0 * (b0 - a0) + y1 * (b1 - a0) + y2 * (b2 - a0)) + x1 * (y0 * (b0 - a1) + y1 * (b1 - a1) + y2 * (b2 - a1))
      + x2 * (y0 * (b0 - a2) + y1 * (b1 - a2) + y2 * (b2 - a2))) with
      ((x0 + x1 + x2) * (y0 * b0 + y1 * b1 + y2 * b2) - (y0 + y1 + y2) * (x0 * a0 + x1 * a1 + x2 * a2)) in U by ring.
    rewrite <- E, <- S in U. 
    replace ((x0 + x1 + x2) * (x0 * a0 + x1 * a1 + x2 * a2) - (x0 + x1 + x2) * (x0 * a0 + x1 * a1 + x2 * a2)) with 0 in U by ring.
    rewrite sg0 in U. discriminate.
  Qed.

  Lemma apart_sound a0 a1 a2 b0 b1 b2 x0 x1 x2 y0 y1 y2 : 
    Forall (fun x => sg x <> N) [x0; x1; x2; y0; y1; y2] -> sg (x0 + x1 + x2) = P -> x0 + x1 + x2 = y0 + y1 + y2 ->
    x0 * a0 + x1 * a1 + x2 * a2 = y0 * b0 + y1 * b1 + y2 * b2 -> apart [a0; a1; a2] [b0; b1; b2] = false.
  Proof.
    intros G K S E. unfold apart. destruct (below [a0; a1; a2] [b0; b1; b2]) eqn:A; [exfalso; eapply below_apart; eauto|].
    cbn [orb]. destruct (below [b0; b1; b2] [a0; a1; a2]) eqn:B; auto. exfalso.
    refine (below_apart _ _ _ _ _ _ y0 y1 y2 x0 x1 x2 B _ _ _ (eq_sym E)); [|now rewrite <- S|now symmetry].
    repeat rewrite Forall_cons_iff in *. tauto.
  Qed.

  Lemma coordinate v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 : meets_at origin v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 ->
    Forall (fun c : vec -> C => x0 * 0 + x1 * c v1 + x2 * c v2 = x3 * c w0 + x4 * c w1 + x5 * c w2) [X; Y; Z].
  Proof. intros (E & _). unfold combine in E. cbn in E. injection E as E1 E2 E3. auto. Qed.

  Lemma boxes_sound v1 v2 w0 w1 w2 : meet origin v1 v2 w0 w1 w2 -> boxes_apart v1 v2 w0 w1 w2 = false.
  Proof.
    intros (x0 & x1 & x2 & x3 & x4 & x5 & M). pose proof (coordinate _ _ _ _ _ _ _ _ _ _ _ M) as E.
    destruct M as (_ & S & G & K). unfold boxes_apart.
    induction E as [|c cs E Es IH]; cbn -[apart]; auto. rewrite IH, orb_false_r. eapply apart_sound; eauto.
  Qed.

  (** ** One line *)
  Lemma forallb_false {A} (p : A -> bool) l : forallb p l = false -> exists x, In x l /\ p x = false.
  Proof.
    induction l as [|x l IH]; cbn; [discriminate|]. destruct (p x) eqn:E; cbn; [intros H; destruct (IH H) as (y & ? & ?); eauto|eauto].
  Qed.
  Lemma not_below a b : below a b = false -> exists x y, In x a /\ In y b /\ sg (y - x) <> P.
  Proof.
    unfold below. intros H. apply forallb_false in H as (x & I & H). apply forallb_false in H as (y & J & H).
    exists x, y. repeat split; auto. intros E. rewrite E in H. discriminate.
  Qed.
  Lemma unit_weights a a0 a1 a2 : In a [a0; a1; a2] -> exists x0 x1 x2,
    Forall (fun x => sg x <> N) [x0; x1; x2] /\ x0 + x1 + x2 = 1 /\ x0 * a0 + x1 * a1 + x2 * a2 = a.
  Proof.
    assert (A : sg 1 <> N) by (rewrite sg_one; discriminate). assert (B : sg 0 <> N) by (rewrite sg0; discriminate).
    intros [<-|[<-|[<-|[]]]]; [exists 1, 0, 0|exists 0, 1, 0|exists 0, 0, 1]; repeat split; auto; try ring.
  Qed.
  Lemma ge_mul a b : sg a <> N -> sg b <> N -> sg (a * b) <> N.
  Proof. rewrite sg_mul. destruct (sg a), (sg b); cbn; congruence. Qed.
  Lemma ge_add a b : sg a <> N -> sg b <> N -> sg (a + b) <> N.
  Proof. rewrite sg_add_cases. destruct (sg a), (sg b); congruence. Qed.

  Lemma line a0 a1 a2 b0 b1 b2 : apart [a0; a1; a2] [b0; b1; b2] = false -> exists x0 x1 x2 y0 y1 y2,
    Forall (fun x => sg x <> N) [x0; x1; x2; y0; y1; y2] /\ sg (x0 + x1 + x2) = P /\ x0 + x1 + x2 = y0 + y1 + y2 /\
    x0 * a0 + x1 * a1 + x2 * a2 = y0 * b0 + y1 * b1 + y2 * b2.
  Proof.
    unfold apart. rewrite orb_false_iff. intros [H K].
    apply not_below in H as (a & b & Ia & Ib & H). apply not_below in K as (b' & a' & Ib' & Ia' & K).
    destruct (unit_weights _ _ _ _ Ia) as (r0 & r1 & r2 & Gr & Sr & Er).
    destruct (unit_weights _ _ _ _ Ib) as (s0 & s1 & s2 & Gs & Ss & Es).
    destruct (unit_weights _ _ _ _ Ia') as (t0 & t1 & t2 & Gt & St & Et).
    destruct (unit_weights _ _ _ _ Ib') as (u0 & u1 & u2 & Gu & Su & Eu).
    repeat rewrite Forall_cons_iff in *.
    assert (H' : sg (a - b) <> N). { replace (a - b) with (- (b - a)) by ring. rewrite sg_opp. destruct (sg (b - a)); cbn; congruence. }
    assert (K' : sg (b' - a') <> N). { replace (b' - a') with (- (a' - b')) by ring. rewrite sg_opp. destruct (sg (a' - b')); cbn; congruence. }
    destruct (sg (a - b)) eqn:P1; try congruence; destruct (sg (b' - a')) eqn:P2; try congruence.
    1: { assert (E : a = b) by (apply sg_zero in P1; transitivity (a - b + b); [ring|rewrite P1; ring]).
      exists r0, r1, r2, s0, s1, s2. repeat rewrite Forall_cons_iff. repeat split; try tauto; try constructor.
      - now rewrite Sr, sg_one. - now rewrite Sr, Ss. - now rewrite Er, Es. }
    all: set (d := a - b) in *; set (d' := b' - a') in *;
      assert (Q : sg (d + d') = P) by (rewrite sg_add_cases, P1, P2; reflexivity);
      assert (Gd : sg d <> N) by congruence; assert (Gd' : sg d' <> N) by congruence;
      exists (d' * r0 + d * t0), (d' * r1 + d * t1), (d' * r2 + d * t2), (d' * s0 + d * u0), (d' * s1 + d * u1), (d' * s2 + d * u2);
      repeat rewrite Forall_cons_iff; repeat split; try (apply ge_add; apply ge_mul; tauto); try constructor;
      [rewrite <- Q; f_equal; transitivity (d' * (r0 + r1 + r2) + d * (t0 + t1 + t2)); [ring|rewrite Sr, St; ring]
      |transitivity (d' * (r0 + r1 + r2) + d * (t0 + t1 + t2)); [ring|rewrite Sr, St, <- Ss, <- Su at 1; rewrite Ss, Su; 
         transitivity (d' * (s0 + s1 + s2) + d * (u0 + u1 + u2)); [rewrite Ss, Su; ring|ring]]
      |transitivity (d' * (r0 * a0 + r1 * a1 + r2 * a2) + d * (t0 * a0 + t1 * a1 + t2 * a2)); [ring|];
       transitivity (d' * (s0 * b0 + s1 * b1 + s2 * b2) + d * (u0 * b0 + u1 * b1 + u2 * b2)); [|ring];
       rewrite Er, Et, Es, Eu; unfold d, d'; ring].
  Qed.

  (** ** One plane *)
  Lemma normal_kills v1 v2 w0 w1 w2 m : Forall (fun v => sign_of (fifteen v1 v2 w0 w1 w2) v = O) determinants ->
    In m (moments v1 v2 w0 w1 w2) -> Forall (fun p => dot m p = 0) [v1; v2; w0; w1; w2].
  Proof.
    intros A I. unfold determinants in A. repeat rewrite Forall_cons_iff in A. unfold sign_of in A.
    cbn -[dot cross] in A. rewrite !sg_zero in A.
    destruct A as (A0 & A1 & A2 & E & _ & _ & D0 & D1 & D2 & _ & _ & _ & E0 & E1 & E2 & _).
    assert (O0 : forall x, - x = 0 -> x = 0) by (intros x H; transitivity (- - x); [ring|rewrite H; ring]).
    apply O0 in D0, D1, D2. unfold moments in I. cbn [In] in I.
    destruct I as [<-|[<-|[<-|[<-|[]]]]]; repeat apply Forall_cons; try apply Forall_nil;
      first [assumption
        |etransitivity; [|exact D0]; unfold dot, cross; cbn; ring|etransitivity; [|exact D1]; unfold dot, cross; cbn; ring
        |etransitivity; [|exact D2]; unfold dot, cross; cbn; ring|etransitivity; [|exact E0]; unfold dot, cross; cbn; ring
        |etransitivity; [|exact E1]; unfold dot, cross; cbn; ring|etransitivity; [|exact E2]; unfold dot, cross; cbn; ring
        |etransitivity; [|exact E]; unfold dot, cross; cbn; ring|unfold dot, cross; cbn; ring].
  Qed.

  Lemma some_moment_in c v1 v2 w0 w1 w2 : some_moment v1 v2 w0 w1 w2 c = true -> exists m, In m (moments v1 v2 w0 w1 w2) /\ c m <> 0.
  Proof.
    unfold some_moment. rewrite existsb_exists. intros (m & I & H). exists m. split; auto.
    intros E. apply sg_zero in E. rewrite E in H. discriminate.
  Qed.

  Lemma seen along c v1 v2 w0 w1 w2 : In (along, c) [(along_x, X); (along_y, Y); (along_z, Z)] -> some_moment v1 v2 w0 w1 w2 c = true ->
    ~ Forall (fun v => L.plane_sign (along origin) (along v1) (along v2) (along w0) (along w1) (along w2) v = O) plane_moments.
  Proof.
    intros J H A. apply some_moment_in in H as (m & I & H). apply H.
    unfold plane_moments in A. repeat rewrite Forall_cons_iff in A. unfold L.plane_sign, L.twenty in A.
    cbn -[L.orient along_x along_y along_z] in A. rewrite !sg_zero in A. destruct A as (A0 & A1 & A2 & A3 & _).
    unfold moments in I. cbn [In] in I, J.
    destruct J as [[= <- <-]|[[= <- <-]|[[= <- <-]|[]]]];
    destruct I as [<-|[<-|[<-|[<-|[]]]]]; unfold L.orient in *; cbn in *;
      first [transitivity (- 0); [rewrite <- A3; ring|ring]|rewrite <- A0; ring|rewrite <- A1; ring|rewrite <- A2; ring].
  Qed.

  Definition lifted (m v1 v2 w0 w1 w2 : vec) (x0 x1 x2 x3 x4 x5 : C) (c : vec -> C) : C :=
    x0 * 0 + x1 * c v1 + x2 * c v2 - (x3 * c w0 + x4 * c w1 + x5 * c w2).
  Lemma lift along c v1 v2 w0 w1 w2 m x0 x1 x2 x3 x4 x5 : In (along, c) [(along_x, X); (along_y, Y); (along_z, Z)] ->
    Forall (fun p => dot m p = 0) [v1; v2; w0; w1; w2] -> c m <> 0 ->
    L.meets2 (along origin) (along v1) (along v2) (along w0) (along w1) (along w2) x0 x1 x2 x3 x4 x5 ->
    meets_at origin v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5.
  Proof.
    intros J A NZ (E1 & E2 & S & G & K). repeat rewrite Forall_cons_iff in A. destruct A as (A1 & A2 & B0 & B1 & B2 & _).
    unfold dot in *. split; [|auto].
    set (q := x1 * (X m * X v1 + Y m * Y v1 + Z m * Z v1) + x2 * (X m * X v2 + Y m * Y v2 + Z m * Z v2) -
      (x3 * (X m * X w0 + Y m * Y w0 + Z m * Z w0) + x4 * (X m * X w1 + Y m * Y w1 + Z m * Z w1) + x5 * (X m * X w2 + Y m * Y w2 + Z m * Z w2))).
    assert (Q : q = 0) by (unfold q; rewrite A1, A2, B0, B1, B2; ring).
    assert (U : forall a b, a = b -> a - b = 0) by (intros a b ->; ring).
    assert (T : forall a b, a - b = 0 -> a = b) by (intros a b H; transitivity (a - b + b); [ring|rewrite H; ring]).
    unfold combine. cbn [In] in J. destruct J as [[= <- <-]|[[= <- <-]|[[= <- <-]|[]]]]; cbn in *; f_equal; auto; apply T.
    - destruct (cancel (X m) (x0 * 0 + x1 * X v1 + x2 * X v2 - (x3 * X w0 + x4 * X w1 + x5 * X w2))) as [?|H]; [|tauto|exact H].
      transitivity (q - Y m * (x0 * 0 + x1 * Y v1 + x2 * Y v2 - (x3 * Y w0 + x4 * Y w1 + x5 * Y w2)) - Z m * (x0 * 0 + x1 * Z v1 + x2 * Z v2 - (x3 * Z w0 + x4 * Z w1 + x5 * Z w2))); [unfold q; ring|rewrite Q, (U _ _ E1), (U _ _ E2); ring].
    - destruct (cancel (Y m) (x0 * 0 + x1 * Y v1 + x2 * Y v2 - (x3 * Y w0 + x4 * Y w1 + x5 * Y w2))) as [?|H]; [|tauto|exact H].
      transitivity (q - Z m * (x0 * 0 + x1 * Z v1 + x2 * Z v2 - (x3 * Z w0 + x4 * Z w1 + x5 * Z w2)) - X m * (x0 * 0 + x1 * X v1 + x2 * X v2 - (x3 * X w0 + x4 * X w1 + x5 * X w2))); [unfold q; ring|rewrite Q, (U _ _ E1), (U _ _ E2); ring].
    - destruct (cancel (Z m) (x0 * 0 + x1 * Z v1 + x2 * Z v2 - (x3 * Z w0 + x4 * Z w1 + x5 * Z w2))) as [?|H]; [|tauto|exact H].
      transitivity (q - X m * (x0 * 0 + x1 * X v1 + x2 * X v2 - (x3 * X w0 + x4 * X w1 + x5 * X w2)) - Y m * (x0 * 0 + x1 * Y v1 + x2 * Y v2 - (x3 * Y w0 + x4 * Y w1 + x5 * Y w2))); [unfold q; ring|rewrite Q, (U _ _ E1), (U _ _ E2); ring].
  Qed.
  Lemma projected along c v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 : In (along, c) [(along_x, X); (along_y, Y); (along_z, Z)] ->
    meets_at origin v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 ->
    L.meets2 (along origin) (along v1) (along v2) (along w0) (along w1) (along w2) x0 x1 x2 x3 x4 x5.
  Proof.
    intros J M. pose proof (coordinate _ _ _ _ _ _ _ _ _ _ _ M) as E. destruct M as (_ & S & G & K).
    repeat rewrite Forall_cons_iff in E. destruct E as (E1 & E2 & E3 & _).
    cbn [In] in J. destruct J as [[= <- <-]|[[= <- <-]|[[= <- <-]|[]]]]; cbn; repeat split; auto.
  Qed.

  Lemma plane_right along c v1 v2 w0 w1 w2 : In (along, c) [(along_x, X); (along_y, Y); (along_z, Z)] ->
    Forall (fun v => sign_of (fifteen v1 v2 w0 w1 w2) v = O) determinants -> some_moment v1 v2 w0 w1 w2 c = true ->
    parted v1 v2 w0 w1 w2 along || boxes_apart v1 v2 w0 w1 w2 = false <-> meet origin v1 v2 w0 w1 w2.
  Proof.
    intros J A N. split.
    - rewrite orb_false_iff. intros [H _]. destruct (L.plane_complete _ _ _ _ _ _ (seen _ _ _ _ _ _ _ J N) H) as (x0 & x1 & x2 & x3 & x4 & x5 & M).
      apply some_moment_in in N as (m & I & NZ). exists x0, x1, x2, x3, x4, x5. eapply lift; eauto. now apply normal_kills.
    - intros H. rewrite (boxes_sound _ _ _ _ _ H), orb_false_r. destruct H as (x0 & x1 & x2 & x3 & x4 & x5 & M).
      destruct (parted _ _ _ _ _ _) eqn:Q; auto. exfalso. unfold parted in Q. apply existsb_exists in Q as (e & I & Q).
      eapply L.parts_apart; eauto. eapply projected; eauto.
  Qed.

  (** ** One line, or two lines through V0 *)
  Definition parallel (u v : vec) : Prop := cross u v = origin.
  Lemma vec_eq u v : X u = X v -> Y u = Y v -> Z u = Z v -> u = v.
  Proof. destruct u, v; cbn; intros; subst; auto. Qed.
  Lemma parallel_coordinates u v : parallel u v -> forall c d, In c [X; Y; Z] -> In d [X; Y; Z] -> c u * d v = d u * c v.
  Proof.
    unfold parallel, cross, origin. intros [= A B K].
    assert (T : forall a b, a - b = 0 -> a = b) by (intros a b H; transitivity (a - b + b); [ring|rewrite H; ring]).
    apply T in A, B, K. intros c d [<-|[<-|[<-|[]]]] [<-|[<-|[<-|[]]]]; auto; try ring.
  Qed.
  Lemma coordinates_parallel u v : (forall c d, In c [X; Y; Z] -> In d [X; Y; Z] -> c u * d v = d u * c v) -> parallel u v.
  Proof. intros H. unfold parallel, cross, origin. f_equal; rewrite H; cbn; auto; ring. Qed.
  Lemma nonzero_coordinate v : zero_vec v = false -> exists c, In c [X; Y; Z] /\ c v <> 0.
  Proof.
    unfold zero_vec. rewrite !andb_false_iff. intros [[H|H]|H]; [exists X|exists Y|exists Z]; cbn; split; auto;
    intros E; apply sg_zero in E; rewrite E in H; discriminate.
  Qed.
  Lemma zero_vec_eq v : zero_vec v = true <-> v = origin.
  Proof.
    unfold zero_vec. rewrite !andb_true_iff, !seq_eq, !sg_zero. destruct v; cbn. unfold origin. split; [intros [[-> ->] ->]; auto|intros [= -> -> ->]; auto].
  Qed.
  Lemma parallel_trans g u v : g <> origin -> parallel g u -> parallel g v -> parallel u v.
  Proof.
    intros NZ A B. destruct (nonzero_coordinate g) as (k & Ik & K).
    { destruct (zero_vec g) eqn:E; auto. apply zero_vec_eq in E. tauto. }
    pose proof (parallel_coordinates _ _ A) as A'. pose proof (parallel_coordinates _ _ B) as B'.
    apply coordinates_parallel. intros c d Ic Id.
    assert (T : forall a b, a - b = 0 -> a = b) by (intros a b H; transitivity (a - b + b); [ring|rewrite H; ring]).
    apply T. destruct (cancel (k g * k g) (c u * d v - d u * c v)) as [H|H]; auto.
    - transitivity ((k g * c u) * (k g * d v) - (k g * d u) * (k g * c v)); [ring|].
      rewrite (A' k c), (A' k d), (B' k c), (B' k d) by auto. ring.
    - exfalso. destruct (cancel _ _ H); auto.
  Qed.
  Lemma parallel_sym u v : parallel u v -> parallel v u.
  Proof. unfold parallel, cross, origin. intros [= A B K]. f_equal; [transitivity (- 0); [rewrite <- A|]|transitivity (- 0); [rewrite <- B|]|transitivity (- 0); [rewrite <- K|]]; ring. Qed.
  Lemma parallel_origin u : parallel u origin.
  Proof. unfold parallel, cross, origin; cbn. f_equal; ring. Qed.
  Lemma parallel_self u : parallel u u.
  Proof. unfold parallel, cross, origin; cbn. f_equal; ring. Qed.

  Lemma first_of_spec vs : (first_of vs = origin /\ Forall (fun v => v = origin) vs) \/ (In (first_of vs) vs /\ first_of vs <> origin).
  Proof.
    unfold first_of. induction vs as [|v vs IH]; cbn; [left; auto|].
    destruct (zero_vec v) eqn:E; cbn.
    - apply zero_vec_eq in E. destruct IH as [[A B]|[A B]]; [left; auto|right; auto].
    - right. split; auto. intros ->. assert (K : zero_vec origin = true) by now apply zero_vec_eq. congruence.
  Qed.

  (** Points on one line: a common point along a coordinate in which the line has extent is one. *)
  Lemma line_lift g k v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 : In k [X; Y; Z] -> k g <> 0 -> Forall (parallel g) [v1; v2; w0; w1; w2] ->
    Forall (fun x => sg x <> N) [x0; x1; x2; x3; x4; x5] -> sg (x0 + x1 + x2) = P -> x0 + x1 + x2 = x3 + x4 + x5 ->
    x0 * 0 + x1 * k v1 + x2 * k v2 = x3 * k w0 + x4 * k w1 + x5 * k w2 -> meets_at origin v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5.
  Proof.
    intros Ik K A G Q S E. repeat rewrite Forall_cons_iff in A. destruct A as (A1 & A2 & B0 & B1 & B2 & _). split; [|auto].
    assert (T : forall a b, a - b = 0 -> a = b) by (intros a b H; transitivity (a - b + b); [ring|rewrite H; ring]).
    assert (U : forall c, In c [X; Y; Z] -> x0 * 0 + x1 * c v1 + x2 * c v2 = x3 * c w0 + x4 * c w1 + x5 * c w2).
    { intros c Ic. apply T. destruct (cancel (k g) (x0 * 0 + x1 * c v1 + x2 * c v2 - (x3 * c w0 + x4 * c w1 + x5 * c w2))) as [H|H]; [|tauto|exact H].
      transitivity (x1 * (k g * c v1) + x2 * (k g * c v2) - (x3 * (k g * c w0) + x4 * (k g * c w1) + x5 * (k g * c w2))); [ring|].
      rewrite (parallel_coordinates _ _ A1 k c Ik Ic), (parallel_coordinates _ _ A2 k c Ik Ic), (parallel_coordinates _ _ B0 k c Ik Ic),
        (parallel_coordinates _ _ B1 k c Ik Ic), (parallel_coordinates _ _ B2 k c Ik Ic).
      transitivity (c g * ((x0 * 0 + x1 * k v1 + x2 * k v2) - (x3 * k w0 + x4 * k w1 + x5 * k w2))); [ring|]. rewrite E. ring. }
    unfold combine. cbn. f_equal; apply U; cbn; auto.
  Qed.

  Lemma pairwise a b c : parallel a b -> parallel b c -> parallel c a -> forall u v, In u [a; b; c] -> In v [a; b; c] -> parallel u v.
  Proof.
    intros A B K u v [<-|[<-|[<-|[]]]] [<-|[<-|[<-|[]]]]; auto using parallel_sym, parallel_self.
  Qed.
  Lemma parallel_combine g x y z u v w : parallel g u -> parallel g v -> parallel g w -> parallel g (combine x y z u v w).
  Proof.
    intros A B K. apply coordinates_parallel. intros c d Ic Id.
    pose proof (parallel_coordinates _ _ A c d Ic Id) as A'. pose proof (parallel_coordinates _ _ B c d Ic Id) as B'.
    pose proof (parallel_coordinates _ _ K c d Ic Id) as K'.
    assert (E : forall c, In c [X; Y; Z] -> c (combine x y z u v w) = x * c u + y * c v + z * c w) by (intros ? [<-|[<-|[<-|[]]]]; reflexivity).
    rewrite !E by auto. transitivity (x * (c g * d u) + y * (c g * d v) + z * (c g * d w)); [ring|]. rewrite A', B', K'. ring.
  Qed.
  Lemma apart_zero b0 b1 b2 : apart [0] [b0; b1; b2] = apart [0; 0; 0] [b0; b1; b2].
  Proof.
    unfold apart, below. cbn. destruct (seq (sg (b0 - 0)) P), (seq (sg (b1 - 0)) P), (seq (sg (b2 - 0)) P),
      (seq (sg (0 - b0)) P), (seq (sg (0 - b1)) P), (seq (sg (0 - b2)) P); reflexivity.
  Qed.
  Lemma boxes_coordinate k v1 v2 w0 w1 w2 : In k [X; Y; Z] -> boxes_apart v1 v2 w0 w1 w2 = false -> apart [0; k v1; k v2] [k w0; k w1; k w2] = false.
  Proof. unfold boxes_apart. cbn -[apart]. rewrite !orb_false_iff. intros [<-|[<-|[<-|[]]]]; tauto. Qed.

  Lemma lines_right v1 v2 w0 w1 w2 : parallel v1 v2 -> parallel w0 w1 -> parallel w1 w2 -> parallel w2 w0 ->
    (if zero_vec (cross (first_of [v1; v2]) (first_of [w0; w1; w2])) then boxes_apart v1 v2 w0 w1 w2
     else existsb (fun c : vec -> C => apart [0] [c w0; c w1; c w2]) [X; Y; Z]) = false <-> meet origin v1 v2 w0 w1 w2.
  Proof.
    intros Pv P0 P1 P2. pose proof (pairwise _ _ _ P0 P1 P2) as PW.
    set (v := first_of [v1; v2]). set (w := first_of [w0; w1; w2]).
    destruct (zero_vec (cross v w)) eqn:U.
    - split; [|apply boxes_sound]. intros H. apply zero_vec_eq in U. change (parallel v w) in U.
      assert (T : forall g, g <> origin -> Forall (parallel g) [v1; v2; w0; w1; w2] -> meet origin v1 v2 w0 w1 w2).
      { intros g NZ A. destruct (nonzero_coordinate g) as (k & Ik & K).
        { destruct (zero_vec g) eqn:E; auto. apply zero_vec_eq in E. tauto. }
        destruct (line _ _ _ _ _ _ (boxes_coordinate k _ _ _ _ _ Ik H)) as (x0 & x1 & x2 & x3 & x4 & x5 & G & Q & S & E).
        exists x0, x1, x2, x3, x4, x5. eapply line_lift; eauto. }
      destruct (first_of_spec [w0; w1; w2]) as [[Ew Aw]|[Iw Nw]]; destruct (first_of_spec [v1; v2]) as [[Ev Av]|[Iv Nv]];
        try fold v in Ev; try fold v in Iv; try fold v in Nv; try fold w in Ew; try fold w in Iw; try fold w in Nw.
      + repeat rewrite Forall_cons_iff in *. destruct Aw as (-> & -> & -> & _). destruct Av as (-> & -> & _).
        exists 1, 0, 0, 1, 0, 0. split; [reflexivity|split; [reflexivity|split]].
        * repeat rewrite Forall_cons_iff. rewrite ?sg0, ?sg_one. repeat split; try discriminate. constructor.
        * replace (1 + 0 + 0) with 1 by ring; apply sg_one.
      + apply (T v Nv). repeat rewrite Forall_cons_iff in Aw. destruct Aw as (-> & -> & -> & _).
        assert (V : parallel v v1 /\ parallel v v2) by (cbn [In] in Iv; destruct Iv as [<-|[<-|[]]]; auto using parallel_self, parallel_sym).
        repeat apply Forall_cons; try apply Forall_nil; try apply parallel_origin; tauto.
      + apply (T w Nw). repeat rewrite Forall_cons_iff in Av. destruct Av as (-> & -> & _).
        repeat apply Forall_cons; try apply Forall_nil; try apply parallel_origin; (apply PW; [exact Iw|cbn; auto]).
      + apply (T w Nw).
        assert (V : parallel v v1 /\ parallel v v2) by (cbn [In] in Iv; destruct Iv as [<-|[<-|[]]]; auto using parallel_self, parallel_sym).
        repeat apply Forall_cons; try apply Forall_nil; try (apply (parallel_trans v); tauto); (apply PW; [exact Iw|cbn; auto]).
    - assert (Nv : v <> origin). { intros E. rewrite E in U. assert (K : zero_vec (cross origin w) = true) by (apply zero_vec_eq, parallel_sym, parallel_origin). congruence. }
      assert (Nw : w <> origin). { intros E. rewrite E in U. assert (K : zero_vec (cross v origin) = true) by apply zero_vec_eq, parallel_origin. congruence. }
      destruct (first_of_spec [w0; w1; w2]) as [[Ew _]|[Iw _]]; [exfalso; exact (Nw Ew)|]. fold w in Iw.
      destruct (first_of_spec [v1; v2]) as [[Ev _]|[Iv _]]; [exfalso; exact (Nv Ev)|]. fold v in Iv.
      assert (V : parallel v v1 /\ parallel v v2) by (cbn [In] in Iv; destruct Iv as [<-|[<-|[]]]; auto using parallel_self, parallel_sym).
      assert (W : parallel w w0 /\ parallel w w1 /\ parallel w w2) by (repeat split; apply PW; cbn; auto).
      split; intros H.
      + destruct (nonzero_coordinate w) as (k & Ik & K).
        { destruct (zero_vec w) eqn:E; auto. apply zero_vec_eq in E. tauto. }
        assert (H' : apart [0; k origin; k origin] [k w0; k w1; k w2] = false).
        { assert (Z0 : k origin = 0) by (destruct Ik as [<-|[<-|[<-|[]]]]; reflexivity). rewrite Z0.
          rewrite <- apart_zero. cbn -[apart] in H. rewrite !orb_false_iff in H. destruct Ik as [<-|[<-|[<-|[]]]]; tauto. }
        destruct (line _ _ _ _ _ _ H') as (x0 & x1 & x2 & x3 & x4 & x5 & G & Q & S & E).
        assert (M : meets_at origin origin origin w0 w1 w2 x0 x1 x2 x3 x4 x5).
        { apply (line_lift w k); auto. repeat rewrite Forall_cons_iff. repeat split; try tauto; auto using parallel_origin. }
        destruct M as (M & _). repeat rewrite Forall_cons_iff in G.
        exists (x0 + x1 + x2), 0, 0, x3, x4, x5. split; [|split; [|split]].
        * rewrite <- M. unfold combine, origin. cbn. f_equal; ring.
        * rewrite <- S. ring.
        * repeat rewrite Forall_cons_iff. rewrite Q, !sg0. repeat split; try tauto; discriminate.
        * rewrite <- Q. f_equal. ring.
      + destruct H as (x0 & x1 & x2 & x3 & x4 & x5 & M).
        assert (Z0 : combine x0 x1 x2 origin v1 v2 = origin).
        { destruct (zero_vec (combine x0 x1 x2 origin v1 v2)) eqn:E; [now apply zero_vec_eq|exfalso].
          assert (NZ : combine x0 x1 x2 origin v1 v2 <> origin) by (intros F; apply zero_vec_eq in F; congruence).
          enough (zero_vec (cross v w) = true) by congruence. apply zero_vec_eq. apply (parallel_trans _ _ _ NZ).
          - apply parallel_sym, parallel_combine; try tauto. apply parallel_origin.
          - apply parallel_sym. destruct M as (M & _). rewrite M. apply parallel_combine; tauto. }
        destruct M as (M & S & G & Q). rewrite Z0 in M. unfold combine, origin in M. injection M as M1 M2 M3.
        assert (T : forall a b c, 0 = x3 * a + x4 * b + x5 * c -> apart [0] [a; b; c] = false).
        { intros a b c E. rewrite apart_zero. apply (apart_sound _ _ _ _ _ _ x0 x1 x2 x3 x4 x5); auto. rewrite <- E. ring. }
        cbn -[apart]. rewrite !T; auto.
  Qed.

  (** ** The theorem *)
  Lemma no_moment v1 v2 w0 w1 w2 : some_moment v1 v2 w0 w1 w2 X = false -> some_moment v1 v2 w0 w1 w2 Y = false ->
    some_moment v1 v2 w0 w1 w2 Z = false -> Forall (fun m => m = origin) (moments v1 v2 w0 w1 w2).
  Proof.
    intros A B K. apply Forall_forall. intros m I. apply zero_vec_eq. unfold zero_vec.
    assert (T : forall c, some_moment v1 v2 w0 w1 w2 c = false -> seq (sg (c m)) O = true).
    { intros c H. destruct (seq (sg (c m)) O) eqn:E; auto. enough (some_moment v1 v2 w0 w1 w2 c = true) by congruence.
      unfold some_moment. apply existsb_exists. exists m. rewrite E. auto. }
    now rewrite !T.
  Qed.

  Theorem separate_right v1 v2 w0 w1 w2 : separate v1 v2 w0 w1 w2 = false <-> meet origin v1 v2 w0 w1 w2.
  Proof.
    unfold separate. set (f := sign_of (fifteen v1 v2 w0 w1 w2)).
    assert (T : forall vs, forallb (fun v => seq (f v) O) vs = true <-> Forall (fun v => f v = O) vs).
    { intros vs. rewrite forallb_forall, Forall_forall. split; intros H v I; [apply seq_eq|apply seq_eq]; auto. }
    destruct (forallb _ [1; 2; 3; 4; 5; 6]%positive) eqn:F; [destruct (forallb _ [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive) eqn:G|].
    - apply T in F, G.
      assert (A : Forall (fun v => f v = O) determinants) by exact (proj2 (Forall_app _ [1; 2; 3; 4; 5; 6]%positive _) (conj F G)).
      unfold in_plane.
      destruct (some_moment _ _ _ _ _ X) eqn:MX; [apply (plane_right _ X); cbn; auto|].
      destruct (some_moment _ _ _ _ _ Y) eqn:MY; [apply (plane_right _ Y); cbn; auto|].
      destruct (some_moment _ _ _ _ _ Z) eqn:MZ; [apply (plane_right _ Z); cbn; auto|].
      pose proof (no_moment _ _ _ _ _ MX MY MZ) as N. unfold moments in N. repeat rewrite Forall_cons_iff in N.
      destruct N as (N0 & N1 & N2 & N3 & _). now apply lines_right.
    - split; [discriminate|]. intros M. exfalso. pose proof (common_hits _ _ _ _ _ M) as H. fold f in H.
      assert (NZ : ~ Forall (fun v => f v = O) determinants).
      { intros A. apply (Forall_app _ [1; 2; 3; 4; 5; 6]%positive [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive) in A.
        destruct A as [_ A]. apply T in A. congruence. }
      specialize (H NZ). apply T in F. repeat rewrite Forall_cons_iff in F. destruct F as (F1 & F2 & F3 & F4 & F5 & F6 & _).
      cbn in H. unfold hits in H. rewrite F1, F2, F3, F4, F5, F6 in H. cbn in H. rewrite !andb_false_r in H. discriminate.
    - rewrite negb_false_iff. split; [apply hits_common|]. intros M. apply (common_hits _ _ _ _ _ M). fold f.
      intros A. apply (Forall_app _ [1; 2; 3; 4; 5; 6]%positive [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive) in A.
      destruct A as [A _]. apply T in A. congruence.
  Qed.

  Theorem exact_right p0 p1 p2 q0 q1 q2 : exact_separate p0 p1 p2 q0 q1 q2 = false <-> meet p0 p1 p2 q0 q1 q2.
  Proof. unfold exact_separate. rewrite separate_right. symmetry. apply meet_shift. Qed.
End Exact.
