(** The axis unit from its words to its verdict: sections 3 to 7 of docs/contract.md, proved as in docs/proofs.md.

    Every signal encloses its true number, whatever the rule for upper bounds, the policy for duplicate projections, the number of
    axes, the shift of axes and the roundings are. So `separate` is the answer only for triangles without a common point, and
    `intersect` only for triangles with one: [axis_unit_is_right]. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.Triple Efsat.Vectors Efsat.Verdict Efsat.RealSpace Efsat.Interval Efsat.DeterminantUnit.
Import ListNotations.
Local Open Scope Z_scope.

(** * What the unit computes *)
(** A rounding: bits dropped, zeros appended if that is negative; the rule for upper bounds, [true] sticky, [false] implied, none
    if they are rounded down too; and a bound to which numbers are saturated. *)
Record rule := Rule { drop : Z; upper : option bool; clamp : option Z }.
Definition raised (u : option bool) x d := match u with
  | None => Z.shiftr x d | Some true => - Z.shiftr (- x) d | Some false => if 0 <? d then Z.shiftr x d + 1 else Z.shiftr x d end.
Definition clamped c x := match c with None => x | Some c => Z.max (- c) (Z.min x c) end.
Definition bring r a := I (clamped (clamp r) (Z.shiftr (lo a) (drop r))) (clamped (clamp r) (raised (upper r) (hi a) (drop r))).
Definition negated a := I (- hi a) (- lo a).
Definition hull a b := I (Z.min (lo a) (lo b)) (Z.max (hi a) (hi b)).
Definition shifted a n := I (Z.shiftl (lo a) n) (Z.shiftl (hi a) n).
Definition ivec := triple interval.
Definition idot (a b : ivec) := sum (sum (product (a T0) (b T0)) (product (a T1) (b T1))) (product (a T2) (b T2)).
Definition icross (a b : ivec) i := let j := next i in let k := next j in difference (product (a j) (b k)) (product (a k) (b j)).
(** By how many places, at most [most], both bounds can go left and stay below 2^length. *)
Definition bits m := if m =? 0 then 0 else Z.log2 m + 1.
Definition free_places a length most := Z.min (Z.max (length - bits (Z.lor (Z.abs (lo a)) (Z.abs (hi a)))) 0) most.

(** The formats of a parameter set: fraction bits, and what numbers are saturated to. *)
Record format := Format { fraction_bits : Z; saturated : option Z }.
Inductive policy := All | Skip | Intersected.
Record table := Table { N : Z; T : Z; K : Z; sticky : bool; frame : transform; renormalise : bool; axis_places : Z; outward : bool;
  duplicates : policy; seventeen : bool; edge_test : bool; grid : Z;
  edge_a : triple format; edge_b : format; normal_a : format; normal_b : format; cross_a : triple format; in_plane_a : triple format; in_plane_b : format;
  image_normal_a : Z; image_normal_b : Z; image_cross : triple Z; image_in_plane_a : triple Z; image_in_plane_b : Z }.
Record words := Words { A : triple (triple (Z * bool)); B : triple (triple (Z * bool)); M : triple (triple (Z * bool)); t : triple (Z * bool); bypass : bool }.

Section Unit.
  Variable o : table.
  Definition read (x : Z * bool) := I (fst x) (fst x + if sticky o then if snd x then 1 else 0 else 1).
  Definition reads (v : triple (Z * bool)) : ivec := tab (fun i => read (v i)).
  Definition from fraction f := Rule (fraction - fraction_bits f) (Some (sticky o)) (saturated f).

  (** Section 3. *)
  Definition placed i l : ivec := match frame o, bypass i with
    | Off, _ | _, true => reads (B i l)
    | Translate, _ => tab (fun j => sum (read (B i l j)) (read (t i j)))
    | On, _ => let f := T o - K o in tab (fun j => bring (Rule f (Some (sticky o)) None) (sum (idot (reads (M i j)) (reads (B i l))) (shifted (read (t i j)) f))) end.

  (** Section 4, along one axis: the origin, and the places by which all go left. *)
  Definition moved x origin := I (lo x - origin) (hi x - origin).
  Definition places_along (a b : triple ivec) j :=
    let around (x : triple ivec) := hull (hull (x T0 j) (x T1 j)) (x T2 j) in
    free_places (moved (hull (around a) (around b)) (lo (a T0 j))) (T o + 1) (T o + 1).
  Definition normalised (a b : triple ivec) : triple ivec * triple ivec :=
    if renormalise o then
      let places := tab (places_along a b) in
      let to (x : triple ivec) := tab (fun k => tab (fun j => bring (Rule (T o + 3 - N o) (Some (sticky o)) None) (shifted (moved (x k j) (lo (a T0 j))) (places j)))) in
      (to a, to b)
    else let to (x : triple ivec) := tab (fun k => tab (fun j => bring (Rule (T o - N o) (Some (sticky o)) None) (x k j))) in (to a, to b).

  (** Section 5: edges and axes. *)
  Definition edge (x : triple ivec) k r : ivec := tab (fun j => bring r (difference (x (next k) j) (x k j))).
  Definition cross (e f : ivec) r : ivec :=
    let exact := tab (icross e f) in
    if axis_places o =? 0 then tab (fun i => bring r (exact i)) else
    let places := free_places (bring r (hull (hull (exact T0) (exact T1)) (exact T2))) (N o - 1) (axis_places o) in
    tab (fun i => bring r (shifted (exact i) places)).
  Definition normal (e : triple ivec) r := cross (e T0) (tab (fun j => negated (e T2 j))) r.
  Record test := Test { points_a : triple ivec; points_b : triple ivec; edges_a : triple ivec; edges_b : triple ivec; n_a : ivec; n_b : ivec }.
  Definition prepared (p : triple ivec * triple ivec) :=
    let '(a, b) := p in
    let ea := tab (fun k => edge a k (from (grid o) (edge_a o k))) in let eb := tab (fun l => edge b l (from (grid o) (edge_b o))) in
    Test a b ea eb (normal ea (from (fraction_bits (edge_a o T0) + fraction_bits (edge_a o T2)) (normal_a o)))
      (normal eb (from (2 * fraction_bits (edge_b o)) (normal_b o))).
  Inductive axis := NormalA | NormalB | Cross (k l : three) | InPlaneA (k : three) | InPlaneB (l : three).
  Definition eleven := [NormalA; NormalB; Cross T0 T0; Cross T0 T1; Cross T0 T2; Cross T1 T0; Cross T1 T1; Cross T1 T2; Cross T2 T0; Cross T2 T1; Cross T2 T2].
  Definition in_planes := [InPlaneA T0; InPlaneA T1; InPlaneA T2; InPlaneB T0; InPlaneB T1; InPlaneB T2].
  Definition axes := eleven ++ if seventeen o then in_planes else [].
  Definition direction (p : test) a := match a with
    | NormalA => n_a p | NormalB => n_b p
    | Cross k l => cross (edges_a p k) (edges_b p l) (from (fraction_bits (edge_a o k) + fraction_bits (edge_b o)) (cross_a o k))
    | InPlaneA k => cross (n_a p) (edges_a p k) (from (fraction_bits (normal_a o) + fraction_bits (edge_a o k)) (in_plane_a o k))
    | InPlaneB l => cross (n_b p) (edges_b p l) (from (fraction_bits (normal_b o) + fraction_bits (edge_b o)) (in_plane_b o)) end.

  (** Projections. *)
  Definition format_of a := match a with NormalA => normal_a o | NormalB => normal_b o | Cross k _ => cross_a o k | InPlaneA k => in_plane_a o k | InPlaneB _ => in_plane_b o end.
  Definition image_bits a := match a with NormalA => image_normal_a o | NormalB => image_normal_b o | Cross k _ => image_cross o k | InPlaneA k => image_in_plane_a o k | InPlaneB _ => image_in_plane_b o end.
  Definition image_rule a := Rule (grid o + fraction_bits (format_of a) - image_bits a) (if outward o then Some (sticky o) else None) None.
  (** The vertices that project to one number, and the one that is kept. *)
  Definition is (i k : three) := match i, k with T0, T0 | T1, T1 | T2, T2 => true | _, _ => false end.
  Definition ends k i := is i k || is i (next k).
  Definition same_a a i := match a with NormalA => true | Cross k _ | InPlaneA k => ends k i | _ => false end.
  Definition same_b a i := match a with NormalB => true | Cross _ l | InPlaneB l => ends l i | _ => false end.
  Definition kept_a a := match a with Cross k _ | InPlaneA k => k | _ => T0 end.
  Definition kept_b a := match a with Cross _ l | InPlaneB l => l | _ => T0 end.
  Definition image a (d : ivec) (points : triple ivec) (same : three -> bool) kept : ivec :=
    let of i := bring (image_rule a) (idot (points i) d) in
    match duplicates o with
    | Skip => let one := of kept in tab (fun i => if is i kept then one else if same i then one else of i)
    | _ => tab of end.
  Definition images (p : test) a := let d := direction p a in (image a d (points_a p) (same_a a) (kept_a a), image a d (points_b p) (same_b a) (kept_b a)).
  Definition meet_of (x y : interval) := I (Z.max (lo x) (lo y)) (Z.min (hi x) (hi y)).
  Definition intersected (x : ivec) (same : three -> bool) : ivec :=
    let members := map (fun i => x i) (filter same [T0; T1; T2]) in
    match members with [] => x | m :: ms => let one := fold_left meet_of ms m in tab (fun i => if same i then one else x i) end.
  Definition compared a (x : ivec * ivec) := match duplicates o with Intersected => (intersected (fst x) (same_a a), intersected (snd x) (same_b a)) | _ => x end.

  (** Section 6. *)
  Definition least (f : interval -> Z) (x : ivec) := Z.min (Z.min (f (x T0)) (f (x T1))) (f (x T2)).
  Definition most (f : interval -> Z) (x : ivec) := Z.max (Z.max (f (x T0)) (f (x T1))) (f (x T2)).
  Definition is_separated (x : ivec * ivec) := let '(a, b) := x in (most hi a <? least lo b) || (most hi b <? least lo a).
  Definition is_overlapping (x : ivec * ivec) := let '(a, b) := x in (least hi a <? most lo b) && (least hi b <? most lo a).

  (** Section 7: on which side of a number another certainly is, and the signs of the fifteen of Table.v that are certain. *)
  Definition side_of (a b : interval) := if hi a <? lo b then P else if hi b <? lo a then Sign.N else O.
  Definition certain_signs (all : list (axis * (ivec * ivec))) : list sign :=
    let of i f := match nth_error all i with Some (_, x) => f x | None => O end in
    let cross k l i := of i (fun x => side_of (fst x k) (snd x l)) in
    [of 0%nat (fun x => side_of (fst x T0) (snd x T0)); of 0%nat (fun x => side_of (fst x T0) (snd x T1)); of 0%nat (fun x => side_of (fst x T0) (snd x T2));
     of 1%nat (fun x => side_of (fst x T0) (snd x T0)); of 1%nat (fun x => side_of (fst x T1) (snd x T0)); of 1%nat (fun x => side_of (fst x T2) (snd x T0));
     cross T0 T0 2%nat; cross T0 T1 3%nat; cross T0 T2 4%nat; cross T1 T0 5%nat; cross T1 T1 6%nat; cross T1 T2 7%nat; cross T2 T0 8%nat; cross T2 T1 9%nat; cross T2 T2 10%nat].
  Definition passes (signs : list sign) := existsb (at_edge pierces (sign_at signs)) edge_list.
  Definition decided (p : test) :=
    let all := map (fun a => (a, images p a)) axes in
    let flags := map (fun x => let c := compared (fst x) (snd x) in (is_separated c, is_overlapping c)) all in
    let separated := map fst flags in let overlapping := map snd flags in
    Outcome (if existsb (fun x => x) separated then Separate
      else if (if edge_test o then passes (certain_signs all) else false) || forallb (fun x => x) (firstn 11 overlapping) then Intersect else Unknown) separated overlapping.
  Definition unit i := let b := tab (placed i) in let a := tab (fun k => reads (A i k)) in decided (prepared (normalised a b)).
End Unit.

(** * Enclosures *)
(** A power of two with any exponent: what a rounding by d bits divides by. *)
Definition part (d : Z) : R := powerRZ 2 (- d).
Lemma part_pos d : (0 < part d)%R.
Proof. apply powerRZ_lt. lra. Qed.
Lemma part_pow d : 0 <= d -> (part d * IZR (2 ^ d) = 1)%R.
Proof.
  intros H. unfold part. assert (E : IZR (2 ^ d) = powerRZ 2 d).
  { rewrite <- (Z2Nat.id d) by auto. rewrite <- pow_IZR, <- pow_powerRZ. reflexivity. }
  rewrite E, <- powerRZ_add by lra. replace (- d + d) with 0 by lia. reflexivity.
Qed.
Lemma part_neg d : d <= 0 -> part d = IZR (2 ^ (- d)).
Proof. intros H. unfold part. rewrite <- (Z2Nat.id (- d)) by lia. rewrite <- pow_IZR, <- pow_powerRZ. reflexivity. Qed.
Lemma part_add a b : (part (a + b) = part a * part b)%R.
Proof. unfold part. rewrite Z.opp_add_distr. apply powerRZ_add. lra. Qed.

Lemma shiftr_part x d : (IZR (Z.shiftr x d) <= IZR x * part d < IZR (Z.shiftr x d) + 1)%R.
Proof.
  destruct (Z.le_ge_cases 0 d) as [H|H].
  - rewrite Z.shiftr_div_pow2 by auto. assert (P : 0 < 2 ^ d) by (apply Z.pow_pos_nonneg; lia).
    pose proof (Z.mul_div_le x (2 ^ d) P) as A. pose proof (Z.mul_succ_div_gt x (2 ^ d) P) as B.
    apply IZR_le in A. apply IZR_lt in B. rewrite mult_IZR in A, B. rewrite succ_IZR in B.
    apply IZR_lt in P. pose proof (part_pow d H) as E. set (D := IZR (2 ^ d)) in *. set (q := IZR (x / 2 ^ d)) in *.
    assert (X : (IZR x * part d * D = IZR x)%R) by (rewrite Rmult_assoc, E; ring).
    split; apply (Rmult_le_reg_r D) || apply (Rmult_lt_reg_r D); auto; rewrite X; lra.
  - rewrite Z.shiftr_mul_pow2 by lia. rewrite mult_IZR, part_neg by lia. lra.
Qed.
Lemma raised_sticky x d : (IZR x * part d <= IZR (raised (Some true) x d))%R.
Proof. cbn. rewrite opp_IZR. pose proof (shiftr_part (- x) d) as [A _]. rewrite opp_IZR in A. lra. Qed.
Lemma raised_up u x d : (IZR x * part d <= IZR (raised (Some u) x d))%R.
Proof.
  destruct u; [apply raised_sticky|]. cbn. destruct (Z.ltb_spec 0 d).
  - rewrite plus_IZR. pose proof (shiftr_part x d). lra.
  - rewrite Z.shiftr_mul_pow2 by lia. rewrite mult_IZR, part_neg by lia. lra.
Qed.
Lemma raised_any u x d : (IZR x * part d < IZR (raised u x d) + 1)%R.
Proof. destruct u as [u|]; [pose proof (raised_up u x d); lra|apply shiftr_part]. Qed.

Definition within_clamp (c : option Z) (x : R) := match c with None => True | Some c => (Rabs x <= IZR c)%R end.
Lemma clamped_low c l x : within_clamp c x -> (IZR l <= x)%R -> (IZR (clamped c l) <= x)%R.
Proof.
  destruct c as [c|]; cbn; auto. intros B A. apply Rabs_le_inv in B.
  destruct (Z.max_spec (- c) (Z.min l c)) as [[_ ->]|[_ ->]]; [|rewrite opp_IZR; lra].
  destruct (Z.min_spec l c) as [[_ ->]|[H ->]]; [auto|]. apply IZR_le in H. lra.
Qed.
Lemma clamped_high c h x : within_clamp c x -> (x <= IZR h)%R -> (x <= IZR (clamped c h))%R.
Proof.
  destruct c as [c|]; cbn; auto. intros B A. apply Rabs_le_inv in B.
  destruct (Z.max_spec (- c) (Z.min h c)) as [[_ ->]|[H ->]].
  - destruct (Z.min_spec h c) as [[_ ->]|[_ ->]]; lra.
  - apply IZR_le in H. destruct (Z.min_spec h c) as [[H' E]|[H' E]]; rewrite E in H; lra.
Qed.
Theorem bring_encloses r a x u : upper r = Some u -> within_clamp (clamp r) (x * part (drop r)) -> encloses a x -> encloses (bring r a) (x * part (drop r)).
Proof.
  intros U C [A B]. pose proof (part_pos (drop r)) as P. unfold encloses, bring; cbn [lo hi]. rewrite U. split.
  - apply clamped_low; auto. pose proof (shiftr_part (lo a) (drop r)). nra.
  - apply clamped_high; auto. pose proof (raised_up u (hi a) (drop r)). nra.
Qed.
(** What comparisons need: if both bounds are rounded down, this is all there is. *)
Definition shown a x := (IZR (lo a) <= x < IZR (hi a) + 1)%R.
Theorem bring_shown r a x : clamp r = None -> encloses a x -> shown (bring r a) (x * part (drop r)).
Proof.
  intros C [A B]. pose proof (part_pos (drop r)) as P. unfold shown, bring; cbn [lo hi]. rewrite C. cbn [clamped].
  pose proof (shiftr_part (lo a) (drop r)). pose proof (raised_any (upper r) (hi a) (drop r)). nra.
Qed.
Lemma negated_encloses a x : encloses a x -> encloses (negated a) (- x).
Proof. unfold encloses; cbn. rewrite !opp_IZR. lra. Qed.
Lemma shifted_encloses a n x : 0 <= n -> encloses a x -> encloses (shifted a n) (x * IZR (2 ^ n)).
Proof.
  intros H [A B]. assert (P : 0 < 2 ^ n) by (apply Z.pow_pos_nonneg; lia). apply IZR_lt in P.
  unfold encloses, shifted; cbn. rewrite !Z.shiftl_mul_pow2, !mult_IZR by auto. nra.
Qed.
Lemma free_places_pos a length most : 0 <= most -> 0 <= free_places a length most.
Proof. unfold free_places. lia. Qed.

(** * Vectors *)
Definition comp (v : vec) i : R := match i with T0 => X v | T1 => Y v | T2 => Z_ v end.
Definition times (k : R) (v : vec) := V3 (k * X v) (k * Y v) (k * Z_ v).
Definition vencloses (a : ivec) (v : vec) := forall i, encloses (a i) (comp v i).
Definition vencloses3 (a : triple ivec) (p : three -> vec) := forall k, vencloses (a k) (p k).
Lemma idot_encloses a b u v : vencloses a u -> vencloses b v -> encloses (idot a b) (dot u v).
Proof. intros A B. unfold idot, dot. repeat apply sum_encloses; apply product_encloses; first [exact (A T0)|exact (A T1)|exact (A T2)|exact (B T0)|exact (B T1)|exact (B T2)]. Qed.
Lemma icross_encloses a b u v i : vencloses a u -> vencloses b v -> encloses (icross a b i) (comp (Vectors.cross u v) i).
Proof. intros A B. unfold icross, Vectors.cross. destruct i; cbn; apply difference_encloses; apply product_encloses; first [exact (A T0)|exact (A T1)|exact (A T2)|exact (B T0)|exact (B T1)|exact (B T2)]. Qed.
Lemma comp_times k v i : comp (times k v) i = (k * comp v i)%R.
Proof. now destruct i. Qed.
Lemma cross_times k l u v : Vectors.cross (times k u) (times l v) = times (k * l) (Vectors.cross u v).
Proof. unfold Vectors.cross, times; cbn. f_equal; ring. Qed.
Lemma comp_minus u v i : comp (minus u v) i = (comp u i - comp v i)%R.
Proof. now destruct i. Qed.

Section Right.
  Variable o : table.
  Hypothesis Places : 0 <= axis_places o.

  (** An axis encloses a positive multiple of the true one. *)
  Definition encloses_multiple a v := exists k, (0 < k)%R /\ vencloses a (times k v).
  Lemma edge_encloses x p k r u : upper r = Some u -> vencloses3 x p ->
    (forall i, within_clamp (clamp r) (comp (minus (p (next k)) (p k)) i * part (drop r))) ->
    vencloses (edge x k r) (times (part (drop r)) (minus (p (next k)) (p k))).
  Proof.
    intros U H C i. unfold edge. rewrite get_tab, comp_times, Rmult_comm. eapply bring_encloses; eauto.
    rewrite comp_minus. apply difference_encloses; apply H.
  Qed.
  Lemma cross_encloses e f r u k l v w : upper r = Some u -> vencloses e (times k v) -> vencloses f (times l w) -> (0 < k)%R -> (0 < l)%R ->
    (if axis_places o =? 0 then forall i, within_clamp (clamp r) (k * l * comp (Vectors.cross v w) i * part (drop r)) else clamp r = None) ->
    encloses_multiple (cross o e f r) (Vectors.cross v w).
  Proof.
    intros U E F Hk Hl C. pose proof (fun i => icross_encloses _ _ _ _ i E F) as K.
    assert (K' : forall i, encloses (icross e f i) (k * l * comp (Vectors.cross v w) i)) by (intros i; specialize (K i); now rewrite cross_times, comp_times in K).
    clear K. pose proof (part_pos (drop r)). unfold cross. destruct (axis_places o =? 0).
    - exists (k * l * part (drop r))%R. split; [repeat apply Rmult_lt_0_compat; auto|]. intros i. rewrite !get_tab, comp_times.
      replace (k * l * part (drop r) * comp (Vectors.cross v w) i)%R with (k * l * comp (Vectors.cross v w) i * part (drop r))%R by ring.
      eapply bring_encloses; eauto.
    - set (n := free_places _ _ _). assert (Hn : 0 <= n) by now apply free_places_pos.
      assert (P : 0 < 2 ^ n) by (apply Z.pow_pos_nonneg; lia). apply IZR_lt in P.
      exists (k * l * IZR (2 ^ n) * part (drop r))%R. split; [repeat apply Rmult_lt_0_compat; auto|]. intros i. rewrite get_tab, comp_times.
      replace (k * l * IZR (2 ^ n) * part (drop r) * comp (Vectors.cross v w) i)%R with (k * l * comp (Vectors.cross v w) i * IZR (2 ^ n) * part (drop r))%R by ring.
      eapply bring_encloses; eauto; [rewrite C; exact Logic.I|]. apply shifted_encloses; auto. rewrite get_tab. apply K'.
  Qed.

  (** ** One pair, after section 4: points and what encloses them *)
  Variables a b : triple ivec. Variables p q : three -> vec.
  Hypothesis HA : vencloses3 a p. Hypothesis HB : vencloses3 b q.
  Let ea k := minus (p (next k)) (p k). Let eb l := minus (q (next l)) (q l).
  Let na := Vectors.cross (ea T0) (minus (p T2) (p T0)). Let nb := Vectors.cross (eb T0) (minus (q T2) (q T0)).
  Let drop_a k := grid o - fraction_bits (edge_a o k). Let drop_b := grid o - fraction_bits (edge_b o).
  Let drop_na := fraction_bits (edge_a o T0) + fraction_bits (edge_a o T2) - fraction_bits (normal_a o).
  Let drop_nb := 2 * fraction_bits (edge_b o) - fraction_bits (normal_b o).
  (** Numbers are saturated to bounds on their true values only. *)
  Definition saturation_holds : Prop :=
    (forall k i, within_clamp (saturated (edge_a o k)) (comp (ea k) i * part (drop_a k))) /\
    (forall l i, within_clamp (saturated (edge_b o)) (comp (eb l) i * part drop_b)) /\
    (if axis_places o =? 0 then (forall i, within_clamp (saturated (normal_a o)) (part (drop_a T0) * part (drop_a T2) * comp na i * part drop_na)) /\
        (forall i, within_clamp (saturated (normal_b o)) (part drop_b * part drop_b * comp nb i * part drop_nb))
      else saturated (normal_a o) = None /\ saturated (normal_b o) = None) /\
    (forall k, saturated (cross_a o k) = None) /\ (forall k, saturated (in_plane_a o k) = None) /\ saturated (in_plane_b o) = None.
  Hypothesis Sat : saturation_holds.
  Let t := prepared o (a, b).

  Lemma edges_right : (forall k, vencloses (edges_a t k) (times (part (drop_a k)) (ea k))) /\ (forall l, vencloses (edges_b t l) (times (part drop_b) (eb l))).
  Proof.
    destruct Sat as (S1 & S2 & _). split; intros k; unfold t, prepared; cbn [edges_a edges_b]; rewrite get_tab; (eapply edge_encloses; [reflexivity|assumption|]); [exact (S1 k)|exact (S2 k)].
  Qed.
  Lemma negated_edge (e : ivec) k u v : vencloses e (times k (minus u v)) -> vencloses (tab (fun j => negated (e j))) (times k (minus v u)).
  Proof.
    intros H i. rewrite get_tab. replace (comp (times k (minus v u)) i) with (- comp (times k (minus u v)) i)%R by (rewrite !comp_times, !comp_minus; ring).
    apply negated_encloses, H.
  Qed.
  Lemma normals_right : encloses_multiple (n_a t) na /\ encloses_multiple (n_b t) nb.
  Proof.
    destruct edges_right as [Ea Eb]. destruct Sat as (_ & _ & S3 & _). pose proof part_pos as PP.
    split; unfold t, prepared; cbn [n_a n_b]; unfold normal.
    - eapply cross_encloses; [reflexivity|exact (Ea T0)|apply (negated_edge _ _ _ _ (Ea T2))|auto|auto|].
      cbn [drop clamp from]. destruct (axis_places o =? 0); apply S3.
    - eapply cross_encloses; [reflexivity|exact (Eb T0)|apply (negated_edge _ _ _ _ (Eb T2))|auto|auto|].
      cbn [drop clamp from]. destruct (axis_places o =? 0); apply S3.
  Qed.
  (** The true axis. *)
  Definition true_axis x := match x with
    | NormalA => na | NormalB => nb | Cross k l => Vectors.cross (ea k) (eb l)
    | InPlaneA k => Vectors.cross na (ea k) | InPlaneB l => Vectors.cross nb (eb l) end.
  Lemma direction_right x : encloses_multiple (direction o t x) (true_axis x).
  Proof.
    destruct edges_right as [Ea Eb]. destruct normals_right as [Na Nb]. destruct Sat as (_ & _ & _ & S4 & S5 & S6). pose proof part_pos as PP.
    assert (NoClamp : forall (c : option Z) (f : three -> R), c = None -> if axis_places o =? 0 then forall i, within_clamp c (f i) else c = None).
    { intros c f ->. destruct (axis_places o =? 0); cbn; auto. }
    destruct x; cbn [direction true_axis]; auto.
    - eapply cross_encloses; [reflexivity|apply Ea|apply Eb|auto|auto|]. apply NoClamp. cbn. auto.
    - destruct Na as (c & Hc & Na). eapply cross_encloses; [reflexivity|exact Na|apply Ea|auto|auto|]. apply NoClamp. cbn. auto.
    - destruct Nb as (c & Hc & Nb). eapply cross_encloses; [reflexivity|exact Nb|apply Eb|auto|auto|]. apply NoClamp. cbn. auto.
  Qed.

  (** What is shown on an axis, of the true projections times a positive number. *)
  Lemma times_dot k l v : dot v (times k l) = (k * dot l v)%R.
  Proof. unfold dot, times; cbn. ring. Qed.
  Lemma image_right x d k pts same kept r : (0 < k)%R -> vencloses d (times k (true_axis x)) -> vencloses3 pts r ->
    (forall i, same i = true \/ i = kept -> duplicates o = Skip -> dot (true_axis x) (r i) = dot (true_axis x) (r kept)) ->
    forall i, shown (image o x d pts same kept i) (k * part (drop (image_rule o x)) * dot (true_axis x) (r i)).
  Proof.
    intros Hk D P S. assert (of : forall i, shown (bring (image_rule o x) (idot (pts i) d)) (k * part (drop (image_rule o x)) * dot (true_axis x) (r i))).
    { intros i. replace (k * part (drop (image_rule o x)) * dot (true_axis x) (r i))%R with (dot (r i) (times k (true_axis x)) * part (drop (image_rule o x)))%R by (rewrite times_dot; ring).
      apply bring_shown; [reflexivity|]. apply idot_encloses; auto. }
    intros i. unfold image. destruct (duplicates o) eqn:E; rewrite get_tab; auto.
    destruct (is i kept) eqn:K; [|destruct (same i) eqn:L]; auto.
    - rewrite S; auto. right. now destruct i, kept.
    - rewrite S; auto.
  Qed.
  Lemma perpendicular x i : (same_a x i = true \/ i = kept_a x -> dot (true_axis x) (p i) = dot (true_axis x) (p (kept_a x))) /\
    (same_b x i = true \/ i = kept_b x -> dot (true_axis x) (q i) = dot (true_axis x) (q (kept_b x))).
  Proof.
    unfold true_axis, na, nb, ea, eb. destruct x as [| |k l|k|l]; split; (intros [H| ->]; [|reflexivity]); try discriminate H.
    - destruct i; cbn [next kept_a]; unfold dot, Vectors.cross, minus; cbn; ring.
    - destruct i; cbn [next kept_b]; unfold dot, Vectors.cross, minus; cbn; ring.
    - destruct k, i; try discriminate H; cbn [next kept_a]; unfold dot, Vectors.cross, minus; cbn; ring.
    - destruct l, i; try discriminate H; cbn [next kept_b]; unfold dot, Vectors.cross, minus; cbn; ring.
    - destruct k, i; try discriminate H; cbn [next kept_a]; generalize (Vectors.cross (minus (p T1) (p T0)) (minus (p T2) (p T0))); intros v; unfold dot, Vectors.cross, minus; cbn; ring.
    - destruct l, i; try discriminate H; cbn [next kept_b]; generalize (Vectors.cross (minus (q T1) (q T0)) (minus (q T2) (q T0))); intros v; unfold dot, Vectors.cross, minus; cbn; ring.
  Qed.
  Definition shows x (y : ivec * ivec) := exists k, (0 < k)%R /\
    (forall i, shown (fst y i) (k * dot (true_axis x) (p i))) /\ (forall i, shown (snd y i) (k * dot (true_axis x) (q i))).
  Lemma images_right x : shows x (images o t x).
  Proof.
    destruct (direction_right x) as (k & Hk & D). exists (k * part (drop (image_rule o x)))%R. pose proof (part_pos (drop (image_rule o x))).
    split; [now apply Rmult_lt_0_compat|]. split; (apply image_right; auto; intros i Hi _; apply perpendicular; exact Hi).
  Qed.
  Lemma intersected_right (x : ivec) same (f : three -> R) c : (forall i, shown (x i) (f i)) -> (forall i, same i = true -> f i = c) -> forall i, shown (intersected x same i) (f i).
  Proof.
    intros H S. unfold intersected.
    assert (M : forall ms m, shown m c -> Forall (fun y => shown y c) ms -> shown (fold_left meet_of ms m) c).
    { induction ms as [|y ms IH]; intros m Hm F; cbn; auto. inversion F; subst. apply IH; auto. unfold shown, meet_of in *; cbn.
      destruct (Z.max_spec (lo m) (lo y)) as [[_ ->]|[_ ->]], (Z.min_spec (hi m) (hi y)) as [[_ ->]|[_ ->]]; lra. }
    assert (G : Forall (fun y => shown y c) (map (fun i => x i) (filter same [T0; T1; T2]))).
    { apply Forall_forall. intros y I. apply in_map_iff in I as (i & <- & I). apply filter_In in I as [_ I]. rewrite <- (S i I). apply H. }
    destruct (map _ _) as [|m ms]; auto. inversion G; subst. intros i. rewrite get_tab. destruct (same i) eqn:E; auto. rewrite (S i E). now apply M.
  Qed.
  Lemma compared_right x y : shows x y -> shows x (compared o x y).
  Proof.
    intros (k & Hk & A & B). exists k. split; auto. unfold compared. destruct (duplicates o); auto. cbn [fst snd].
    split; eapply intersected_right; eauto; intros i Hi; cbv beta; (rewrite (proj1 (perpendicular x i) (or_introl Hi)); reflexivity) || (rewrite (proj2 (perpendicular x i) (or_introl Hi)); reflexivity).
  Qed.

  (** Section 6: comparisons. *)
  Lemma shown_below u v x y : shown u x -> shown v y -> hi u < lo v -> (x < y)%R.
  Proof. intros [_ A] [B _] H. apply Z.le_succ_l, IZR_le in H. rewrite succ_IZR in H. lra. Qed.
  Lemma most_above f (x : ivec) i : f (x i) <= most f x.
  Proof. unfold most. destruct i; lia. Qed.
  Lemma least_below f (x : ivec) i : least f x <= f (x i).
  Proof. unfold least. destruct i; lia. Qed.
  Lemma most_is f (x : ivec) : exists i, most f x = f (x i).
  Proof. unfold most. destruct (Z.max_spec (Z.max (f (x T0)) (f (x T1))) (f (x T2))) as [[_ ->]|[_ ->]]; [eauto|]. destruct (Z.max_spec (f (x T0)) (f (x T1))) as [[_ ->]|[_ ->]]; eauto. Qed.
  Lemma least_is f (x : ivec) : exists i, least f x = f (x i).
  Proof. unfold least. destruct (Z.min_spec (Z.min (f (x T0)) (f (x T1))) (f (x T2))) as [[_ ->]|[_ ->]]; [|eauto]. destruct (Z.min_spec (f (x T0)) (f (x T1))) as [[_ ->]|[_ ->]]; eauto. Qed.
  Lemma scaled_lt k x y : (0 < k)%R -> (k * x < k * y)%R -> (x < y)%R.
  Proof. intros. apply (Rmult_lt_reg_l k); auto. Qed.
  Lemma separated_right x y : shows x y -> is_separated y = true ->
    (forall i j, dot (true_axis x) (p i) < dot (true_axis x) (q j))%R \/ (forall i j, dot (true_axis x) (q j) < dot (true_axis x) (p i))%R.
  Proof.
    destruct y as [u v]. intros (k & Hk & A & B). cbn [fst snd] in *. unfold is_separated. rewrite orb_true_iff, !Z.ltb_lt.
    intros [H|H]; [left|right]; intros i j; apply (scaled_lt k); auto; eapply shown_below; auto.
    - pose proof (most_above hi u i). pose proof (least_below lo v j). lia.
    - pose proof (most_above hi v j). pose proof (least_below lo u i). lia.
  Qed.
  Lemma overlapping_right x y : shows x y -> is_overlapping y = true ->
    (exists i j, dot (true_axis x) (p i) < dot (true_axis x) (q j))%R /\ (exists i j, dot (true_axis x) (q j) < dot (true_axis x) (p i))%R.
  Proof.
    destruct y as [u v]. intros (k & Hk & A & B). cbn [fst snd] in *. unfold is_overlapping. rewrite andb_true_iff, !Z.ltb_lt. intros [H K].
    destruct (least_is hi u) as [i Hi], (most_is lo v) as [j Hj], (least_is hi v) as [j' Hj'], (most_is lo u) as [i' Hi'].
    split; [exists i, j|exists i', j']; apply (scaled_lt k); auto; eapply shown_below; auto; lia.
  Qed.
  Lemma side_right x y i j : shows x y -> side_of (fst y i) (snd y j) = O \/ side_of (fst y i) (snd y j) = RealNumbers.sg (dot (true_axis x) (q j) - dot (true_axis x) (p i))%R.
  Proof.
    intros (k & Hk & A & B). unfold side_of. destruct (Z.ltb_spec (hi (fst y i)) (lo (snd y j))) as [H|H].
    - right. symmetry. apply RealNumbers.sg_P. pose proof (scaled_lt _ _ _ Hk (shown_below _ _ _ _ (A i) (B j) H)). lra.
    - destruct (Z.ltb_spec (hi (snd y j)) (lo (fst y i))) as [L|L]; [|now left].
      right. symmetry. apply RealNumbers.sg_N. pose proof (scaled_lt _ _ _ Hk (shown_below _ _ _ _ (B j) (A i) L)). lra.
  Qed.
  (** ** The verdict *)
  Let meets := common (place_of (p T0)) (place_of (p T1)) (place_of (p T2)) (place_of (q T0)) (place_of (q T1)) (place_of (q T2)).
  Lemma separates l : (forall i j, dot l (p i) < dot l (q j))%R \/ (forall i j, dot l (q j) < dot l (p i))%R -> ~ meets.
  Proof.
    intros H (x & (k0 & k1 & k2 & A0 & A1 & A2 & AS & AE) & (l0 & l1 & l2 & B0 & B1 & B2 & BS & BE)). unfold place_of in AE, BE. rewrite AE in BE. injection BE as E1 E2 E3.
    assert (E : (k0 * dot l (p T0) + k1 * dot l (p T1) + k2 * dot l (p T2) = l0 * dot l (q T0) + l1 * dot l (q T1) + l2 * dot l (q T2))%R).
    { unfold dot. transitivity (X l * (k0 * X (p T0) + k1 * X (p T1) + k2 * X (p T2)) + Y l * (k0 * Y (p T0) + k1 * Y (p T1) + k2 * Y (p T2)) + Z_ l * (k0 * Z_ (p T0) + k1 * Z_ (p T1) + k2 * Z_ (p T2)))%R; [ring|].
      rewrite E1, E2, E3. ring. }
    assert (M : forall c0 c1 c2 x0 x1 x2 y, (0 <= c0 -> 0 <= c1 -> 0 <= c2 -> c0 + c1 + c2 = 1 -> x0 < y -> x1 < y -> x2 < y -> c0 * x0 + c1 * x1 + c2 * x2 < y)%R).
    { intros c0 c1 c2 x0 x1 x2 y P0 P1 P2 S L0 L1 L2. assert (C : (1 / 3 <= c0 \/ 1 / 3 <= c1 \/ 1 / 3 <= c2)%R) by lra.
      assert (0 <= c0 * (y - x0) /\ 0 <= c1 * (y - x1) /\ 0 <= c2 * (y - x2))%R by (repeat split; apply Rmult_le_pos; lra).
      assert (G : (0 < c0 * (y - x0) + c1 * (y - x1) + c2 * (y - x2))%R).
      { destruct C as [C|[C|C]]; [assert (0 < c0 * (y - x0))%R by (apply Rmult_lt_0_compat; lra)|assert (0 < c1 * (y - x1))%R by (apply Rmult_lt_0_compat; lra)|assert (0 < c2 * (y - x2))%R by (apply Rmult_lt_0_compat; lra)]; lra. }
      replace y with ((c0 + c1 + c2) * y)%R by (rewrite S; ring). lra. }
    destruct H as [H|H].
    - assert (K : forall j, (k0 * dot l (p T0) + k1 * dot l (p T1) + k2 * dot l (p T2) < dot l (q j))%R) by (intros j; apply M; auto).
      assert (L : (l0 * - dot l (q T0) + l1 * - dot l (q T1) + l2 * - dot l (q T2) < - (k0 * dot l (p T0) + k1 * dot l (p T1) + k2 * dot l (p T2)))%R) by (apply M; auto; apply Ropp_lt_contravar; apply K).
      lra.
    - assert (K : forall i, (l0 * dot l (q T0) + l1 * dot l (q T1) + l2 * dot l (q T2) < dot l (p i))%R) by (intros i; apply M; auto).
      assert (L : (k0 * - dot l (p T0) + k1 * - dot l (p T1) + k2 * - dot l (p T2) < - (l0 * dot l (q T0) + l1 * dot l (q T1) + l2 * dot l (q T2)))%R) by (apply M; auto; apply Ropp_lt_contravar; apply K).
      lra.
  Qed.
  Let v1 := there (minus (p T1) (p T0)). Let v2 := there (minus (p T2) (p T0)). Let w l := there (minus (q l) (p T0)).
  Lemma meets_origin : R.S.meet R.S.origin v1 v2 (w T0) (w T1) (w T2) <-> meets.
  Proof.
    unfold meets. rewrite <- (meet_common (there (p T0)) (there (p T1)) (there (p T2)) (there (q T0)) (there (q T1)) (there (q T2))). symmetry. apply R.S.meet_shift.
  Qed.

  Lemma passing_right : passes (certain_signs (map (fun x => (x, images o t x)) (axes o))) = true -> meets.
  Proof.
    intros H. apply meets_origin. set (signs := certain_signs _) in H.
    assert (C : certain (sign_at signs) (R.S.sign_of (R.S.fifteen v1 v2 (w T0) (w T1) (w T2)))).
    { intros v. unfold sign_at, R.S.sign_of, R.S.pick.
      assert (F : Forall2 (fun s r => s = O \/ s = RealNumbers.sg r) signs (R.S.fifteen v1 v2 (w T0) (w T1) (w T2))).
      { unfold signs, certain_signs, axes, eleven. cbn [map app nth_error].
        assert (E : forall x i j r, (dot (true_axis x) (q j) - dot (true_axis x) (p i))%R = r ->
          side_of (fst (images o t x) i) (snd (images o t x) j) = O \/ side_of (fst (images o t x) i) (snd (images o t x) j) = RealNumbers.sg r).
        { intros x i j r <-. apply side_right, images_right. }
        unfold R.S.fifteen, v1, v2, w.
        repeat apply Forall2_cons; try apply Forall2_nil; apply E; unfold true_axis, na, nb, ea, eb; cbn [next];
          unfold there, R.S.cross, R.S.dot, dot, Vectors.cross, minus, RealNumbers.add, RealNumbers.sub, RealNumbers.mul, RealNumbers.opp; cbn; ring. }
      clear H. generalize (place v). induction F as [|s r ss rs Hs F IH]; intros [|i]; cbn; auto. }
    unfold passes in H. apply R.S.hits_common. apply existsb_exists in H as (e & I & H). apply existsb_exists. exists e. split; auto.
    exact (pierces_hits _ _ _ C H).
  Qed.

  Lemma eleven_right : (forall x, In x eleven -> is_overlapping (compared o x (images o t x)) = true) -> meets.
  Proof.
    intros H. apply meets_origin. apply OnReals.A.eleven_axes.
    assert (E : forall x l, In x eleven -> l = there (true_axis x) -> OnReals.A.overlaps [R.S.origin; v1; v2] [w T0; w T1; w T2] l).
    { intros x l I ->. destruct (overlapping_right x _ (compared_right _ _ (images_right x)) (H x I)) as [(i & j & A) (i' & j' & B)].
      assert (Vi : forall i, In (there (minus (p i) (p T0))) [R.S.origin; v1; v2]).
      { intros []; unfold v1, v2; [left|right; left|right; right; left]; auto. unfold there, minus, R.S.origin, RealNumbers.zero; cbn. f_equal; ring. }
      assert (Wj : forall j, In (w j) [w T0; w T1; w T2]) by (intros []; cbn; auto).
      assert (D : forall i j, RealNumbers.sub (R.S.dot (there (true_axis x)) (w j)) (R.S.dot (there (true_axis x)) (there (minus (p i) (p T0)))) = (dot (true_axis x) (q j) - dot (true_axis x) (p i))%R).
      { intros i0 j0. unfold w, R.S.dot, there, dot, minus, RealNumbers.add, RealNumbers.sub, RealNumbers.mul. cbn. ring. }
      split; [exists (there (minus (p i) (p T0))), (w j)|exists (there (minus (p i') (p T0))), (w j')]; (split; [apply Vi|split; [apply Wj|]]); rewrite D;
        [apply RealNumbers.sg_P|apply RealNumbers.sg_N]; lra. }
    unfold OnReals.A.eleven.
    repeat apply Forall_cons; try apply Forall_nil;
      [apply (E NormalA)|apply (E NormalB)|apply (E (Cross T0 T0))|apply (E (Cross T0 T1))|apply (E (Cross T0 T2))|apply (E (Cross T1 T0))|apply (E (Cross T1 T1))|apply (E (Cross T1 T2))
      |apply (E (Cross T2 T0))|apply (E (Cross T2 T1))|apply (E (Cross T2 T2))];
      try (cbn; tauto); unfold v1, v2, w, true_axis, na, nb, ea, eb; cbn [next]; unfold there, R.S.cross, R.S.minus, R.S.origin, Vectors.cross, minus, RealNumbers.sub, RealNumbers.mul, RealNumbers.zero;
      cbn; unfold RealNumbers.sub; f_equal; ring.
  Qed.

  Theorem decided_right : says (verdict (decided o t)) meets.
  Proof.
    unfold decided. cbn [verdict]. rewrite !map_map. cbn [fst snd].
    destruct (existsb (fun x => x) _) eqn:S.
    - split; [|discriminate]. intros _. apply existsb_exists in S as (f & I & ->). apply in_map_iff in I as (x & F & _).
      apply (separates (true_axis x)). exact (separated_right x _ (compared_right _ _ (images_right x)) F).
    - destruct (_ || _) eqn:O; [|split; discriminate]. split; [discriminate|]. intros _. apply orb_true_iff in O as [O|O].
      + destruct (edge_test o); [|discriminate]. now apply passing_right.
      + apply eleven_right. rewrite forallb_forall in O. intros x I. apply O. unfold axes. rewrite map_app.
        rewrite firstn_app, firstn_all2, in_app_iff by (cbn; lia). left. apply in_map_iff. exists x. auto.
  Qed.
End Right.

(** * Section 4: the pair moved to the origin and scaled *)
Section Normalised.
  Variable o : table. Variables a b : triple ivec.
  Definition scale j : R := if renormalise o then (IZR (2 ^ places_along o a b j) * part (T o + 3 - N o))%R else part (T o - N o).
  Definition origin_of j : R := if renormalise o then IZR (lo (a T0 j)) else 0%R.
  Definition to (u : vec) := V3 (scale T0 * (X u - origin_of T0)) (scale T1 * (Y u - origin_of T1)) (scale T2 * (Z_ u - origin_of T2)).
  Lemma comp_to u j : comp (to u) j = (scale j * (comp u j - origin_of j))%R.
  Proof. now destruct j. Qed.
  Lemma places_pos j : 0 <= T o -> 0 <= places_along o a b j.
  Proof. intros H. apply free_places_pos. lia. Qed.
  Lemma scale_pos j : 0 <= T o -> (0 < scale j)%R.
  Proof.
    intros H. unfold scale. destruct (renormalise o); [|apply part_pos]. apply Rmult_lt_0_compat; [|apply part_pos].
    apply IZR_lt, Z.pow_pos_nonneg; [lia|now apply places_pos].
  Qed.
  Lemma moved_encloses y x c : encloses y x -> encloses (moved y c) (x - IZR c).
  Proof. unfold encloses; cbn. rewrite !minus_IZR. lra. Qed.
  Lemma normalised_right p q : 0 <= T o -> vencloses3 a p -> vencloses3 b q ->
    vencloses3 (fst (normalised o a b)) (fun k => to (p k)) /\ vencloses3 (snd (normalised o a b)) (fun k => to (q k)).
  Proof.
    intros HT HA HB.
    assert (G : forall (x : triple ivec) r, vencloses3 x r -> forall k j, encloses (if renormalise o
        then bring (Rule (T o + 3 - N o) (Some (sticky o)) None) (shifted (moved (x k j) (lo (a T0 j))) (places_along o a b j))
        else bring (Rule (T o - N o) (Some (sticky o)) None) (x k j)) (comp (to (r k)) j)).
    { intros x r H k j. rewrite comp_to. unfold scale, origin_of. destruct (renormalise o).
      - replace (IZR (2 ^ places_along o a b j) * part (T o + 3 - N o) * (comp (r k) j - IZR (lo (a T0 j))))%R with
          ((comp (r k) j - IZR (lo (a T0 j))) * IZR (2 ^ places_along o a b j) * part (T o + 3 - N o))%R by ring.
        apply (bring_encloses (Rule _ _ None) _ _ (sticky o)); cbn [upper clamp drop]; auto; [exact Logic.I|]. apply shifted_encloses; [now apply places_pos|].
        apply moved_encloses, H.
      - replace (part (T o - N o) * (comp (r k) j - 0))%R with (comp (r k) j * part (T o - N o))%R by ring.
        apply (bring_encloses (Rule _ _ None) _ _ (sticky o)); cbn [upper clamp drop]; auto; [exact Logic.I|]. apply H. }
    unfold normalised. destruct (renormalise o); split; intros k j; cbn [fst snd]; rewrite !get_tab; apply G; auto.
  Qed.
  (** The answer does not change. *)
  Lemma common_to p0 p1 p2 q0 q1 q2 : 0 <= T o ->
    common (place_of (to p0)) (place_of (to p1)) (place_of (to p2)) (place_of (to q0)) (place_of (to q1)) (place_of (to q2)) <->
    common (place_of p0) (place_of p1) (place_of p2) (place_of q0) (place_of q1) (place_of q2).
  Proof.
    intros HT. pose proof (scale_pos T0 HT). pose proof (scale_pos T1 HT). pose proof (scale_pos T2 HT).
    rewrite <- (meet_common (there (to p0)) (there (to p1)) (there (to p2)) (there (to q0)) (there (to q1)) (there (to q2))).
    rewrite <- (meet_common (there p0) (there p1) (there p2) (there q0) (there q1) (there q2)).
    rewrite R.S.meet_shift, (R.S.meet_shift (there p0)).
    pose proof (meet_stretched (scale T0) (scale T1) (scale T2) R.S.origin (R.S.minus (there p1) (there p0)) (R.S.minus (there p2) (there p0))
      (R.S.minus (there q0) (there p0)) (R.S.minus (there q1) (there p0)) (R.S.minus (there q2) (there p0)) ltac:(lra) ltac:(lra) ltac:(lra)) as S.
    assert (E : forall u, R.S.minus (there (to u)) (there (to p0)) = stretched (scale T0) (scale T1) (scale T2) (R.S.minus (there u) (there p0))).
    { intros u. unfold R.S.minus, there, to, stretched, RealNumbers.sub; cbn. unfold RealNumbers.sub. f_equal; ring. }
    rewrite !E. replace (stretched (scale T0) (scale T1) (scale T2) R.S.origin) with R.S.origin in S; [exact S|].
    unfold stretched, R.S.origin, RealNumbers.zero; cbn. f_equal; ring.
  Qed.
End Normalised.

(** * The theorem *)
(** A word stands for a number: its floor, and whether it is off the grid. *)
Definition word_of (w : Z * bool) (x : R) : Prop := floor_of (fst w) x /\ (snd w = false -> x = IZR (fst w)).
Definition words_of (w : triple (Z * bool)) (v : vec) : Prop := forall j, word_of (w j) (comp v j).
Definition stands_for i u : Prop :=
  (forall k, words_of (A i k) (TA u k)) /\ (forall k, words_of (B i k) (TB u k)) /\ (forall k, words_of (M i k) (TM u k)) /\ words_of (t i) (Tt u).
(** B in the frame of A, in ulps. *)
Definition true_placed o i u l : vec := match frame o, bypass i with
  | Off, _ | _, true => TB u l
  | Translate, _ => plus (TB u l) (Tt u)
  | On, _ => let r j := (dot (TM u j) (TB u l) * part (T o - K o))%R in plus (V3 (r T0) (r T1) (r T2)) (Tt u) end.

Lemma read_encloses o w x : word_of w x -> encloses (read o w) x.
Proof.
  intros [[A0 B0] C0]. unfold encloses, read; cbn [lo hi]. rewrite plus_IZR. destruct (sticky o), (snd w); cbn; try rewrite (C0 eq_refl) in *; lra.
Qed.
Lemma reads_encloses o w v : words_of w v -> vencloses (reads o w) v.
Proof. intros H j. unfold reads. rewrite get_tab. now apply read_encloses. Qed.
Lemma placed_right o i u l : 0 <= T o - K o -> stands_for i u -> vencloses (placed o i l) (true_placed o i u l).
Proof.
  intros HF (_ & HB & HM & Ht). unfold placed, true_placed.
  assert (S : forall r, vencloses (reads o (B i l)) r -> vencloses (reads o (B i l)) r) by auto.
  destruct (frame o); [now apply reads_encloses|..]; (destruct (bypass i); [now apply reads_encloses|]).
  - intros j. rewrite get_tab. replace (comp (plus (TB u l) (Tt u)) j) with (comp (TB u l) j + comp (Tt u) j)%R by now destruct j.
    apply sum_encloses; apply read_encloses; [apply HB|apply Ht].
  - intros j. rewrite get_tab.
    assert (E : comp (plus (V3 (dot (TM u T0) (TB u l) * part (T o - K o)) (dot (TM u T1) (TB u l) * part (T o - K o)) (dot (TM u T2) (TB u l) * part (T o - K o))) (Tt u)) j =
      ((dot (TM u j) (TB u l) + comp (Tt u) j * IZR (2 ^ (T o - K o))) * part (T o - K o))%R).
    { pose proof (part_pow _ HF) as P. transitivity (dot (TM u j) (TB u l) * part (T o - K o) + comp (Tt u) j * (part (T o - K o) * IZR (2 ^ (T o - K o))))%R; [rewrite P; destruct j; cbn; ring|ring]. }
    rewrite E. apply (bring_encloses (Rule _ _ None) _ _ (sticky o)); cbn [upper clamp drop]; auto; [exact Logic.I|].
    apply sum_encloses; [apply idot_encloses; apply reads_encloses; auto|]. apply shifted_encloses; auto. apply read_encloses, Ht.
Qed.

Definition a_of o i : triple ivec := tab (fun k => reads o (A i k)).
Definition b_of o i : triple ivec := tab (placed o i).
(** The true points after section 4. *)
Definition true_a o i u k := to o (a_of o i) (b_of o i) (TA u k).
Definition true_b o i u l := to o (a_of o i) (b_of o i) (true_placed o i u l).
Lemma unit_right o i u : 0 <= axis_places o -> 0 <= K o <= T o -> stands_for i u -> saturation_holds o (true_a o i u) (true_b o i u) ->
  says (verdict (unit o i)) (common (place_of (TA u T0)) (place_of (TA u T1)) (place_of (TA u T2))
    (place_of (true_placed o i u T0)) (place_of (true_placed o i u T1)) (place_of (true_placed o i u T2))).
Proof.
  intros HP HT H Sat.
  assert (HA : vencloses3 (a_of o i) (TA u)) by (intros k; unfold a_of; rewrite get_tab; apply reads_encloses, H).
  assert (HB : vencloses3 (b_of o i) (true_placed o i u)) by (intros k; unfold b_of; rewrite get_tab; apply placed_right; [lia|exact H]).
  destruct (normalised_right o _ _ _ _ ltac:(lia) HA HB) as [NA NB].
  pose proof (decided_right o HP _ _ _ _ NA NB Sat) as D. cbv beta in D.
  unfold says in *. rewrite (common_to o (a_of o i) (b_of o i)) in D by lia. unfold unit. fold (a_of o i) (b_of o i).
  rewrite <- surjective_pairing in D. exact D.
Qed.

(** ** Saturation *)
(** A bound on the true differences of A and of B along a coordinate axis, in the last place of the working format (lemma
    edge-extent), and so on the components of normals (lemma triangle-area). *)
Definition keeps x d c := match c with None => true | Some c => raised (Some true) x d <=? c end.
Definition unsaturated (c : option Z) := match c with None => true | Some _ => false end.
Definition saturates_beyond o (extent_a extent_b : Z) : bool :=
  every (fun k => keeps extent_a (grid o - fraction_bits (edge_a o k)) (saturated (edge_a o k))) && keeps extent_b (grid o - fraction_bits (edge_b o)) (saturated (edge_b o))
  && (if axis_places o =? 0 then keeps (extent_a * extent_a) (2 * grid o - fraction_bits (normal_a o)) (saturated (normal_a o)) && keeps (extent_b * extent_b) (2 * grid o - fraction_bits (normal_b o)) (saturated (normal_b o))
    else unsaturated (saturated (normal_a o)) && unsaturated (saturated (normal_b o)))
  && every (fun k => unsaturated (saturated (cross_a o k))) && every (fun k => unsaturated (saturated (in_plane_a o k))) && unsaturated (saturated (in_plane_b o)).
Lemma keeps_right x d c y : keeps x d c = true -> (Rabs y <= IZR x)%R -> within_clamp c (y * part d).
Proof.
  destruct c as [c|]; cbn [keeps within_clamp]; auto. intros H L. apply Z.leb_le, IZR_le in H. pose proof (raised_sticky x d). pose proof (part_pos d).
  rewrite Rabs_mult, (Rabs_pos_eq (part d)) by lra. pose proof (Rmult_le_compat_r (part d) _ _ ltac:(lra) L). lra.
Qed.
Lemma unsaturated_none c : unsaturated c = true -> c = None.
Proof. destruct c; [discriminate|auto]. Qed.
(** Lemma triangle-area, of differences in a box whose sides are e. *)
Lemma triangle_area e (x y z t : R) : (Rabs x <= e -> Rabs y <= e -> Rabs (x - y) <= e -> Rabs z <= e -> Rabs t <= e -> Rabs (z - t) <= e -> Rabs (x * t - y * z) <= e * e)%R.
Proof.
  intros A1 A2 A3 B1 B2 B3. assert (He : (0 <= e)%R) by (eapply Rle_trans; [apply Rabs_pos|exact A1]).
  apply Rabs_le_inv in A1, A2, A3, B1, B2, B3.
  assert (P : forall u v, (0 <= u -> - e <= v <= e -> - (u * e) <= u * v <= u * e)%R) by (intros; nra).
  apply Rabs_le. destruct (Rle_or_lt 0 x) as [Sx|Sx], (Rle_or_lt 0 y) as [Sy|Sy].
  - destruct (Rle_or_lt y x).
    + pose proof (P y (t - z)%R Sy ltac:(lra)). pose proof (P (x - y)%R t ltac:(lra) ltac:(lra)). assert (x * e <= e * e)%R by nra. nra.
    + pose proof (P x (t - z)%R Sx ltac:(lra)). pose proof (P (y - x)%R z ltac:(lra) ltac:(lra)). assert (y * e <= e * e)%R by nra. nra.
  - pose proof (P x t Sx ltac:(lra)). pose proof (P (- y)%R z ltac:(lra) ltac:(lra)). assert ((x - y) * e <= e * e)%R by nra. nra.
  - pose proof (P (- x)%R t ltac:(lra) ltac:(lra)). pose proof (P y z Sy ltac:(lra)). assert ((y - x) * e <= e * e)%R by nra. nra.
  - destruct (Rle_or_lt y x).
    + pose proof (P (- x)%R (t - z)%R ltac:(lra) ltac:(lra)). pose proof (P (x - y)%R z ltac:(lra) ltac:(lra)). assert (- y * e <= e * e)%R by nra. nra.
    + pose proof (P (- y)%R (t - z)%R ltac:(lra) ltac:(lra)). pose proof (P (y - x)%R t ltac:(lra) ltac:(lra)). assert (- x * e <= e * e)%R by nra. nra.
Qed.
Definition extends (p : three -> vec) (e : Z) : Prop := forall i j c, (Rabs (comp (p i) c - comp (p j) c) <= IZR e)%R.
Lemma normal_extent p e c : extends p e -> (Rabs (comp (Vectors.cross (minus (p T1) (p T0)) (minus (p T2) (p T0))) c) <= IZR (e * e))%R.
Proof.
  intros H. rewrite mult_IZR.
  assert (G : forall i j, (Rabs ((comp (p T1) i - comp (p T0) i) * (comp (p T2) j - comp (p T0) j) - (comp (p T2) i - comp (p T0) i) * (comp (p T1) j - comp (p T0) j)) <= IZR e * IZR e)%R).
  { intros i j. apply triangle_area; try apply H;
      [replace (comp (p T1) i - comp (p T0) i - (comp (p T2) i - comp (p T0) i))%R with (comp (p T1) i - comp (p T2) i)%R by ring
      |replace (comp (p T1) j - comp (p T0) j - (comp (p T2) j - comp (p T0) j))%R with (comp (p T1) j - comp (p T2) j)%R by ring]; apply H. }
  destruct c; cbn; [pose proof (G T1 T2) as K|pose proof (G T2 T0) as K|pose proof (G T0 T1) as K]; cbn in K;
    match type of K with (Rabs ?x <= _)%R => match goal with |- (Rabs ?y <= _)%R => replace y with x by ring end end; exact K.
Qed.
Lemma saturation_right o p q ea eb : saturates_beyond o ea eb = true -> extends p ea -> extends q eb -> saturation_holds o p q.
Proof.
  intros H Ea Eb. unfold saturates_beyond in H. rewrite !andb_true_iff, !every_all in H. destruct H as [[[[[H1 H2] H3] H4] H5] H6].
  unfold saturation_holds. split; [|split; [|split; [|split; [|split]]]]; try (intros; apply unsaturated_none; auto).
  - intros k i. rewrite comp_minus. apply (keeps_right ea); [apply H1|apply Ea].
  - intros k i. rewrite comp_minus. apply (keeps_right eb); [apply H2|apply Eb].
  - destruct (axis_places o =? 0); apply andb_true_iff in H3 as [H3 H3']; [|split; now apply unsaturated_none]. split; intros i.
    + replace (part (grid o - fraction_bits (edge_a o T0)) * part (grid o - fraction_bits (edge_a o T2)) * comp (Vectors.cross (minus (p (next T0)) (p T0)) (minus (p T2) (p T0))) i *
        part (fraction_bits (edge_a o T0) + fraction_bits (edge_a o T2) - fraction_bits (normal_a o)))%R with
        (comp (Vectors.cross (minus (p T1) (p T0)) (minus (p T2) (p T0))) i * part (2 * grid o - fraction_bits (normal_a o)))%R.
      * apply (keeps_right (ea * ea)); [exact H3|now apply normal_extent].
      * replace (2 * grid o - fraction_bits (normal_a o)) with ((grid o - fraction_bits (edge_a o T0)) + (grid o - fraction_bits (edge_a o T2)) +
          (fraction_bits (edge_a o T0) + fraction_bits (edge_a o T2) - fraction_bits (normal_a o))) by ring. rewrite !(part_add (_ + _)), (part_add (grid o - _)). cbn [next]. ring.
    + replace (part (grid o - fraction_bits (edge_b o)) * part (grid o - fraction_bits (edge_b o)) * comp (Vectors.cross (minus (q (next T0)) (q T0)) (minus (q T2) (q T0))) i *
        part (2 * fraction_bits (edge_b o) - fraction_bits (normal_b o)))%R with
        (comp (Vectors.cross (minus (q T1) (q T0)) (minus (q T2) (q T0))) i * part (2 * grid o - fraction_bits (normal_b o)))%R.
      * apply (keeps_right (eb * eb)); [exact H3'|now apply normal_extent].
      * replace (2 * grid o - fraction_bits (normal_b o)) with ((grid o - fraction_bits (edge_b o)) + (grid o - fraction_bits (edge_b o)) +
          (2 * fraction_bits (edge_b o) - fraction_bits (normal_b o))) by ring. rewrite !(part_add (_ + _)), (part_add (grid o - _)). cbn [next]. ring.
Qed.
