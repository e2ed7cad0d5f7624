(** Eleven axes, section 7 of docs/proofs.md: if the images of two triangles overlap strictly on n_A, n_B and the nine products of
    edges, the triangles have a common point ([eleven_axes]). And if they have one and are not in one plane, an edge hits even if any one of
    the six is left out ([two_hit]). *)
From Coq Require Import List Bool PArith ZArith Ring Lia.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.Space Efsat.Exact Efsat.Crosses Efsat.Five.
Import ListNotations.

Module Axes (D : DOM).
  Module K := Crosses D.
  Module E := K.E.
  Module S := E.S.
  Import D S.F S.
  Local Open Scope dom.

  Lemma ge_add a b : sg a <> N -> sg b <> N -> sg (a + b) <> N.
  Proof. rewrite sg_add_cases. destruct (sg a), (sg b); congruence. Qed.

  (** On an axis the images of the triangles share more than a point, or one is a point inside the other. *)
  Definition overlaps (us ws : list vec) (l : vec) : Prop :=
    (exists u w, In u us /\ In w ws /\ sg (dot l w - dot l u) = P) /\ (exists u w, In u us /\ In w ws /\ sg (dot l w - dot l u) = N).

  Lemma four_values s t r x : (exists i j : bool, x = s + (if i then r else 0) - (if j then t else 0)) ->
    (sg s <> N -> sg (- t) <> N -> sg r <> N -> sg x <> N) /\ (sg (- s) <> N -> sg t <> N -> sg (- r) <> N -> sg x <> P).
  Proof.
    intros (i & j & ->). assert (Z0 : sg 0 <> N) by (rewrite sg0; discriminate). split; intros A B K.
    - replace (s + (if i then r else 0) - (if j then t else 0)) with (s + (if i then r else 0) + (if j then - t else 0)) by (destruct j; ring).
      destruct i, j; repeat apply ge_add; auto.
    - intros E. assert (F : sg (- s + (if i then - r else 0) + (if j then t else 0)) <> N) by (destruct i, j; repeat apply ge_add; auto).
      apply F. replace (- s + (if i then - r else 0) + (if j then t else 0)) with (- (s + (if i then r else 0) - (if j then t else 0))) by (destruct i, j; ring).
      now rewrite sg_opp, E.
  Qed.
  Lemma cross_axis p0 p1 p2 q0 q1 q2 :
    let l := cross (minus p1 p0) (minus q1 q0) in
    let s := dot l (minus q0 p0) in let t := dot l (minus p2 p0) in let r := dot l (minus q2 q0) in
    forall u w, In u [p0; p1; p2] -> In w [q0; q1; q2] ->
    (sg s <> N -> sg (- t) <> N -> sg r <> N -> sg (dot l w - dot l u) <> N) /\
    (sg (- s) <> N -> sg t <> N -> sg (- r) <> N -> sg (dot l w - dot l u) <> P).
  Proof.
    intros l s t r.
    assert (Z : forall u w, dot l w - dot l u = s + dot l (minus w q0) - dot l (minus u p0)) by (intros; unfold s, dot, minus; cbn; ring).
    intros u w Iu Iw. apply four_values. rewrite Z. cbn [In] in Iu, Iw.
    destruct Iu as [<-|[<-|[<-|[]]]], Iw as [<-|[<-|[<-|[]]]];
    [exists false, false|exists false, false|exists true, false|exists false, false|exists false, false|exists true, false
     |exists false, true|exists false, true|exists true, true];
    unfold r, t, s, l, dot, minus, cross; cbn; ring.
  Qed.

  Definition turn (k : nat) (l : list vec) : list vec := skipn k l ++ firstn k l.
  Lemma turn_in k l u : In u l <-> In u (turn k l).
  Proof. unfold turn. rewrite in_app_iff, or_comm, <- in_app_iff, firstn_skipn. reflexivity. Qed.
  Definition edge (l : list vec) (k : nat) : vec := minus (nth (S k mod 3) l origin) (nth k l origin).

  Section Pair.
    Variables v1 v2 w0 w1 w2 : vec.
    Let A := [origin; v1; v2]. Let B := [w0; w1; w2].
    Definition eleven : list vec := Eval cbn [map flat_map app edge nth Nat.modulo Nat.divmod Nat.sub] in
      let us := [origin; v1; v2] in let ws := [w0; w1; w2] in
      cross v1 v2 :: cross (minus w1 w0) (minus w2 w0) :: flat_map (fun k => map (fun l => cross (edge us k) (edge ws l)) [0; 1; 2]%nat) [0; 1; 2]%nat.

    Lemma opp_le x f : sg x = f -> mem f le = true -> sg (- x) <> N.
    Proof. intros E M. rewrite sg_opp, E. destruct f; cbn in *; congruence. Qed.
    Lemma ge_ge x f : sg x = f -> mem f ge = true -> sg x <> N.
    Proof. intros -> M. destruct f; cbn in *; congruence. Qed.

    Theorem eleven_axes : Forall (overlaps A B) eleven -> meet origin v1 v2 w0 w1 w2.
    Proof.
      intros H. destruct (refuted_sound _ _ axes_refuted (sign_of (fifteen v1 v2 w0 w1 w2))) as (p & I & K).
      rewrite !in_app_iff in I. destruct I as [I|[I|[I|I]]].
      - exfalso. exact (zero_sums _ _ _ (pluecker_holds v1 v2 w0 w1 w2) I K).
      - exfalso. pose proof (edge_sums v1 v2 w0 w1 w2 []) as E. rewrite app_nil_r in E. exact (no_sum_pattern _ _ E I K).
      - exfalso. unfold eleven in H. repeat rewrite Forall_cons_iff in H. destruct H as (NA & NB & H).
        assert (PA : forall u w, In u A -> In w B -> exists v, In v [1; 2; 3]%positive /\ sg (dot (cross v1 v2) w - dot (cross v1 v2) u) = sign_of (fifteen v1 v2 w0 w1 w2) v).
        { intros u w Iu Iw. destruct Iw as [<-|[<-|[<-|[]]]]; [exists 1%positive|exists 2%positive|exists 3%positive]; (split; [cbn; auto|]);
          unfold sign_of; f_equal; cbn; destruct Iu as [<-|[<-|[<-|[]]]]; unfold dot, cross; cbn; ring. }
        assert (PB : forall u w, In u A -> In w B -> exists v, In v [4; 5; 6]%positive /\ sg (dot (cross (minus w1 w0) (minus w2 w0)) w - dot (cross (minus w1 w0) (minus w2 w0)) u) = sign_of (fifteen v1 v2 w0 w1 w2) v).
        { intros u w Iu Iw. destruct Iu as [<-|[<-|[<-|[]]]]; [exists 4%positive|exists 5%positive|exists 6%positive]; (split; [cbn; auto|]);
          unfold sign_of; f_equal; cbn; destruct Iw as [<-|[<-|[<-|[]]]]; unfold dot, cross, minus; cbn; ring. }
        assert (ALL : forall v vs a, In v vs -> holds (sign_of (fifteen v1 v2 w0 w1 w2)) (map (fun v => (v, a)) vs) = true -> mem (sign_of (fifteen v1 v2 w0 w1 w2) v) a = true).
        { intros v vs a Iv M. unfold holds in M. rewrite forallb_forall in M. exact (M (v, a) (in_map (fun v => (v, a)) _ _ Iv)). }
        unfold axis_patterns in I. rewrite !in_app_iff in I. destruct I as [[<-|[<-|[]]]|[[<-|[<-|[]]]|I]].
        + destruct NA as [_ (u & w & Iu & Iw & E)]. destruct (PA u w Iu Iw) as (v & Iv & F). pose proof (ALL _ _ _ Iv K) as M. rewrite <- F, E in M. discriminate.
        + destruct NB as [_ (u & w & Iu & Iw & E)]. destruct (PB u w Iu Iw) as (v & Iv & F). pose proof (ALL _ _ _ Iv K) as M. rewrite <- F, E in M. discriminate.
        + destruct NA as [(u & w & Iu & Iw & E) _]. destruct (PA u w Iu Iw) as (v & Iv & F). pose proof (ALL _ _ _ Iv K) as M. rewrite <- F, E in M. discriminate.
        + destruct NB as [(u & w & Iu & Iw & E) _]. destruct (PB u w Iu Iw) as (v & Iv & F). pose proof (ALL _ _ _ Iv K) as M. rewrite <- F, E in M. discriminate.
        + clear NA NB PA PB ALL.
          destruct H as (H00 & H01 & H02 & H10 & H11 & H12 & H20 & H21 & H22 & _).
          assert (T : forall i j l v b b' a a', In (i, j) (list_prod [0; 1; 2]%nat [0; 1; 2]%nat) ->
            overlaps A B l ->
            match turn i A, turn j B with [p0; p1; p2], [q0; q1; q2] => l = cross (minus p1 p0) (minus q1 q0) /\
              pick (fifteen v1 v2 w0 w1 w2) v = dot l (minus q0 p0) /\
              pick (fifteen v1 v2 w0 w1 w2) a - pick (fifteen v1 v2 w0 w1 w2) a' = dot l (minus p2 p0) /\
              pick (fifteen v1 v2 w0 w1 w2) b - pick (fifteen v1 v2 w0 w1 w2) b' = dot l (minus q2 q0) | _, _ => False end ->
            holds (sign_of (fifteen v1 v2 w0 w1 w2)) [(v, ge); (a, le); (a', ge); (b, ge); (b', le)] = false /\
            holds (sign_of (fifteen v1 v2 w0 w1 w2)) [(v, le); (a, ge); (a', le); (b, le); (b', ge)] = false).
          { intros i j l v b b' a a' _ [(u & w & Iu & Iw & E) (u' & w' & Iu' & Iw' & E')] M.
            rewrite (turn_in i) in Iu, Iu'. rewrite (turn_in j) in Iw, Iw'.
            destruct (turn i A) as [|p0 [|p1 [|p2 [|]]]]; try tauto. destruct (turn j B) as [|q0 [|q1 [|q2 [|]]]]; try tauto.
            destruct M as (-> & Mv & Ma & Mb).
            pose proof (cross_axis p0 p1 p2 q0 q1 q2 u w Iu Iw) as [_ C1]. pose proof (cross_axis p0 p1 p2 q0 q1 q2 u' w' Iu' Iw') as [C2 _].
            rewrite <- Mv, <- Ma, <- Mb in C1, C2.
            set (f := fifteen v1 v2 w0 w1 w2) in *.
            split; match goal with |- ?h = false => destruct h eqn:Hh; auto; exfalso end; cbn [holds forallb fst snd] in Hh;
              rewrite !andb_true_iff in Hh; destruct Hh as (X1 & X2 & X3 & X4 & X5 & _); unfold sign_of in *.
            - apply C2; auto.
              + eapply ge_ge; eauto.
              + replace (- (pick f a - pick f a')) with (- pick f a + pick f a') by ring. apply ge_add; [eapply opp_le|eapply ge_ge]; eauto.
              + replace (pick f b - pick f b') with (pick f b + - pick f b') by ring. apply ge_add; [eapply ge_ge|eapply opp_le]; eauto.
            - apply C1; auto.
              + eapply opp_le; eauto.
              + replace (pick f a - pick f a') with (pick f a + - pick f a') by ring. apply ge_add; [eapply ge_ge|eapply opp_le]; eauto.
              + replace (- (pick f b - pick f b')) with (- pick f b + pick f b') by ring. apply ge_add; [eapply opp_le|eapply ge_ge]; eauto. }
          Ltac one T i j H I K := match type of I with
            | [(?v, _); (?a, _); (?a', _); (?b, _); (?b', _)] = _ \/ _ => destruct I as [<-|[<-|I]];
              [assert (U := T i j _ v b b' a a' ltac:(cbn; tauto) H); destruct U as [U1 U2]; 
                [cbn; unfold dot, cross, minus; cbn; repeat split; ring|congruence]
              |assert (U := T i j _ v b b' a a' ltac:(cbn; tauto) H); destruct U as [U1 U2]; 
                [cbn; unfold dot, cross, minus; cbn; repeat split; ring|congruence]|] end.
          cbn [flat_map app In map] in I.
          one T 0%nat 0%nat H00 I K. one T 1%nat 0%nat H10 I K. one T 2%nat 0%nat H20 I K.
          one T 0%nat 1%nat H01 I K. one T 1%nat 1%nat H11 I K. one T 2%nat 1%nat H21 I K.
          one T 0%nat 2%nat H02 I K. one T 1%nat 2%nat H12 I K. one T 2%nat 2%nat H22 I K. exact I.
      - apply hits_common. exact (hit_list_hits _ _ _ I K).
    Qed.

    (** If the triangles have a common point and do not lie in one plane, two edges hit. *)
    Theorem two_hit : meet origin v1 v2 w0 w1 w2 -> ~ Forall (fun v => sign_of (fifteen v1 v2 w0 w1 w2) v = O) determinants ->
      forall k, (k < 6)%nat -> existsb (hits_edge (sign_of (fifteen v1 v2 w0 w1 w2))) (without k) = true.
    Proof.
      intros (x0 & x1 & x2 & x3 & x4 & x5 & M) NZ k Hk.
      assert (R : refuted 30 (facts ++ hit_list (without k)) = true).
      { pose proof five_refuted as R. rewrite forallb_forall in R. apply R, in_seq. split; [apply Nat.le_0_l|exact Hk]. }
      set (l := fifteen v1 v2 w0 w1 w2 ++ [x0; x1; x2; x3; x4; x5]).
      destruct (refuted_sound _ _ R (sign_of l)) as (p & I & H).
      rewrite in_app_iff in I. destruct I as [I|I]; [exfalso; exact (no_fact _ _ _ _ _ _ _ _ _ _ _ M NZ _ I H)|].
      pose proof (hit_list_hits _ _ _ I H) as E. rewrite <- E.
      clear - Hk. do 6 (destruct k as [|k]; [reflexivity|]). exfalso. lia.
    Qed.
  End Pair.
End Axes.
