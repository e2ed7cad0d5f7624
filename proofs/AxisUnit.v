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
    apply IZR_le in A. apply Z.gt_lt, IZR_lt in B. rewrite mult_IZR in A, B. rewrite succ_IZR in B.
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
Proof. intros A B. unfold idot, dot. repeat apply sum_encloses; apply product_encloses; first [apply (A T0)|apply (A T1)|apply (A T2)|apply (B T0)|apply (B T1)|apply (B T2)]. Qed.
Lemma icross_encloses a b u v i : vencloses a u -> vencloses b v -> encloses (icross a b i) (comp (Vectors.cross u v) i).
Proof. intros A B. unfold icross, Vectors.cross. destruct i; cbn; apply difference_encloses; apply product_encloses; first [apply (A T0)|apply (A T1)|apply (A T2)|apply (B T0)|apply (B T1)|apply (B T2)]. Qed.
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
    - exists (k * l * part (drop r))%R. split; [nra|]. intros i. rewrite !get_tab, comp_times.
      replace (k * l * part (drop r) * comp (Vectors.cross v w) i)%R with (k * l * comp (Vectors.cross v w) i * part (drop r))%R by ring.
      eapply bring_encloses; eauto.
    - set (n := free_places _ _ _). assert (Hn : 0 <= n) by now apply free_places_pos.
      assert (P : 0 < 2 ^ n) by (apply Z.pow_pos_nonneg; lia). apply IZR_lt in P.
      exists (k * l * IZR (2 ^ n) * part (drop r))%R. split; [assert (0 < k * l * IZR (2 ^ n))%R by nra; nra|]. intros i. rewrite get_tab, comp_times.
      replace (k * l * IZR (2 ^ n) * part (drop r) * comp (Vectors.cross v w) i)%R with (k * l * comp (Vectors.cross v w) i * IZR (2 ^ n) * part (drop r))%R by ring.
      eapply bring_encloses; eauto; [rewrite C; exact Logic.I|]. apply shifted_encloses; auto. rewrite get_tab. apply K'.
  Qed.

  (** ** One pair, after section 4: points and what encloses them *)
  Variables a b : triple ivec. Variables p q : three -> vec.
  Hypothesis HA : vencloses3 a p. Hypothesis HB : vencloses3 b q.
  Let ea k := minus (p (next k)) (p k). Let eb l := minus (q (next l)) (q l).
  Let na := Vectors.cross (ea T0) (minus (p T0) (p T2)). Let nb := Vectors.cross (eb T0) (minus (q T0) (q T2)).
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
    destruct Sat as (S1 & S2 & _). split; intros k; unfold t, prepared; cbn [edges_a edges_b]; rewrite get_tab; (eapply edge_encloses; [reflexivity|assumption|]); cbn [drop clamp from]; auto.
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
    - destruct k, i; try discriminate H; cbn [next kept_a]; generalize (Vectors.cross (minus (p T1) (p T0)) (minus (p T0) (p T2))); intros v; unfold dot, Vectors.cross, minus; cbn; ring.
    - destruct l, i; try discriminate H; cbn [next kept_b]; generalize (Vectors.cross (minus (q T1) (q T0)) (minus (q T0) (q T2))); intros v; unfold dot, Vectors.cross, minus; cbn; ring.
  Qed.
  Definition shows x (y : ivec * ivec) := exists k, (0 < k)%R /\
    (forall i, shown (fst y i) (k * dot (true_axis x) (p i))) /\ (forall i, shown (snd y i) (k * dot (true_axis x) (q i))).
  Lemma images_right x : shows x (images o t x).
  Proof.
    destruct (direction_right x) as (k & Hk & D). exists (k * part (drop (image_rule o x)))%R. pose proof (part_pos (drop (image_rule o x))).
    split; [nra|]. split; (apply image_right; auto; intros i Hi _; apply perpendicular; exact Hi).
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
End Right.
