(** A solver need not be trusted where it says why a formula has no solution: docs/machine-proofs.md, "Certificates".

    A certificate is a list of clauses, each with the numbers of the clauses from which it follows: if it were false, these would, one
    after the other, leave one value for a variable, and in the end none. Who reaches the empty clause has shown that nothing satisfies
    the formula: [certified]. This is the format LRAT, without the rule that keeps satisfiability only. *)
From Coq Require Import ZArith PArith List Bool FMapPositive.
Import ListNotations.
Module Map := PositiveMap.

(** Literals as in the format DIMACS: n is a variable, -n its opposite, and 0 is none. *)
Definition clause := list Z.
Definition true_by (v : positive -> bool) (l : Z) : Prop := match l with Zpos p => v p = true | Zneg p => v p = false | Z0 => False end.
Definition satisfies (v : positive -> bool) (c : clause) : Prop := Exists (true_by v) c.
Definition unsatisfiable (formula : list clause) : Prop := forall v, ~ Forall (satisfies v) formula.

(** Values that are known. *)
Definition values := Map.t bool.
Definition is_false (a : values) (l : Z) : bool :=
  match l with
  | Zpos p => match Map.find p a with Some b => negb b | None => false end
  | Zneg p => match Map.find p a with Some b => b | None => false end
  | Z0 => true
  end.
Definition set (l : Z) (a : values) : values := match l with Zpos p => Map.add p true a | Zneg p => Map.add p false a | Z0 => a end.

(** Do the clauses with these numbers contradict the values? *)
Fixpoint contradicted (clauses : Map.t clause) (a : values) (hints : list positive) : bool :=
  match hints with
  | [] => false
  | h :: hints =>
      match Map.find h clauses with
      | None => false
      | Some c => match filter (fun l => negb (is_false a l)) c with
                  | [] => true
                  | [l] => contradicted clauses (set l a) hints
                  | _ => false
                  end
      end
  end.
Inductive step := Learn (number : positive) (c : clause) (hints : list positive) | Forget (numbers : list positive).
Definition opposite_values (c : clause) : values := fold_left (fun a l => set (- l) a) c (Map.empty _).
Fixpoint refutes (clauses : Map.t clause) (steps : list step) : bool :=
  match steps with
  | [] => false
  | Forget numbers :: steps => refutes (fold_left (fun m n => Map.remove n m) numbers clauses) steps
  | Learn n c hints :: steps =>
      if contradicted clauses (opposite_values c) hints
      then match c with [] => true | _ => refutes (Map.add n c clauses) steps end else false
  end.
(** The clauses of the formula have the numbers 1, 2, ... *)
Fixpoint numbered (n : positive) (formula : list clause) : Map.t clause :=
  match formula with [] => Map.empty _ | c :: formula => Map.add n c (numbered (Pos.succ n) formula) end.
Definition refuted_by (formula : list clause) (steps : list step) : bool := refutes (numbered 1 formula) steps.

Definition agrees (v : positive -> bool) (a : values) : Prop := forall p b, Map.find p a = Some b -> v p = b.
Definition all_hold (v : positive -> bool) (m : Map.t clause) : Prop := forall n c, Map.find n m = Some c -> satisfies v c.

Lemma find_add {A} k n (x : A) m : Map.find k (Map.add n x m) = if Pos.eq_dec k n then Some x else Map.find k m.
Proof. destruct (Pos.eq_dec k n) as [->|E]; [apply Map.gss|now apply Map.gso]. Qed.
Lemma agrees_set v a l : agrees v a -> true_by v l -> agrees v (set l a).
Proof. intros A T. destruct l; cbn in *; auto; intros k b; rewrite find_add; destruct (Pos.eq_dec k p) as [->|_]; [intros [= <-]|apply A|intros [= <-]|apply A]; auto. Qed.
Lemma not_false v a l : agrees v a -> true_by v l -> is_false a l = false.
Proof. intros A T. destruct l; cbn in *; [tauto| |]; destruct (Map.find p a) eqn:E; auto; apply A in E; subst; rewrite T; reflexivity. Qed.

Lemma contradiction v clauses hints a : all_hold v clauses -> agrees v a -> contradicted clauses a hints = false.
Proof.
  intros H. revert a. induction hints as [|h hints IH]; intros a A; cbn; auto. destruct (Map.find h clauses) as [c|] eqn:E; auto.
  apply H, Exists_exists in E as (l & I & T).
  assert (J : In l (filter (fun l => negb (is_false a l)) c)) by (apply filter_In; split; auto; now rewrite (not_false v)).
  destruct (filter _ c) as [|l' [|]]; auto; [destruct J|]. destruct J as [<-|[]]. now apply IH, agrees_set.
Qed.
Lemma opposite_agrees v c a : agrees v a -> ~ satisfies v c -> agrees v (fold_left (fun a l => set (- l) a) c a).
Proof.
  revert a. induction c as [|l c IH]; intros a A N; cbn; auto. apply IH; [|intros S; apply N; now right].
  assert (T : ~ true_by v l) by (intros T; apply N; now left).
  destruct l as [|p|p]; [exact A|apply (agrees_set v a (Zneg p) A)|apply (agrees_set v a (Zpos p) A)]; cbn in *; destruct (v p); congruence.
Qed.
Lemma learned v clauses c hints : all_hold v clauses -> contradicted clauses (opposite_values c) hints = true -> satisfies v c.
Proof.
  intros H K. destruct (Exists_dec (true_by v) c) as [S|N]; auto.
  - intros [|p|p]; cbn; [now right| |]; destruct (v p); (now left) || (right; discriminate).
  - rewrite (contradiction v) in K; auto; [discriminate|]. apply opposite_agrees; auto. intros p b. now rewrite Map.gempty.
Qed.
Lemma forgotten v numbers m : all_hold v m -> all_hold v (fold_left (fun m n => Map.remove n m) numbers m).
Proof.
  revert m. induction numbers as [|n numbers IH]; intros m H; cbn; auto. apply IH. intros k c E. apply (H k).
  destruct (Pos.eq_dec k n) as [->|D]; [now rewrite Map.grs in E|now rewrite Map.gro in E].
Qed.
Lemma no_solution v steps m : all_hold v m -> refutes m steps = false.
Proof.
  revert m. induction steps as [|[n c hints|numbers] steps IH]; intros m H; cbn; auto; [|now apply IH, forgotten].
  destruct (contradicted _ _ _) eqn:E; auto. apply (learned v) in E; auto. destruct c as [|l c]; [inversion E|].
  apply IH. intros k d. rewrite find_add. destruct (Pos.eq_dec k n); [now intros [= <-]|apply H].
Qed.
Lemma numbered_hold v formula n : Forall (satisfies v) formula -> all_hold v (numbered n formula).
Proof.
  revert n. induction formula as [|c formula IH]; intros n F k d; cbn; [now rewrite Map.gempty|].
  inversion F; subst. rewrite find_add. destruct (Pos.eq_dec k n); [now intros [= <-]|now apply IH].
Qed.
Theorem certified formula steps : refuted_by formula steps = true -> unsatisfiable formula.
Proof. intros H v F. unfold refuted_by in H. now rewrite (no_solution v) in H by now apply numbered_hold. Qed.
