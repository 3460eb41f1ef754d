/* SPDX-License-Identifier: MIT */
/* An epoch from START TREE to the next: labels, echo, the barrier; parents, the census, the barrier; GROW TREE. Robot 0 is root,
   the last one serves a target. In each step a robot hears all its neighbours, each as it is or as it was. Unless the root's
   patience is over or somebody has died: all have a label when SELECT PARENT opens, and the worker hangs on the root by a chain of parents
   when GROW TREE opens. And when nothing more goes wrong, the epoch ends. */
#include "swarm.pml"

#ifndef DEATHS
#define DEATHS 0
#endif
#ifndef LATES
#define LATES 0    /* barriers that wait too long */
#endif
#ifndef EPOCHS
#define EPOCHS 1
#endif

/* What a robot may do. */
#define STEP 1
#define PATIENT_STEP 2
#define LATE_STEP 3
#define OPEN_EPOCH 4
#define DIE 5

c_decl {
\#include "rules.h"
\#include "graphs.h"
\#include "seen.h"
};
c_state "struct Stage robot[ROBOTS]" "Global"
c_state "struct Stage older[ROBOTS]" "Global"

byte act, me, old1, old2, old3, old4;  /* the next step; 0 between steps */
short graph, graph_count;
byte deaths_left = DEATHS, lates_left = LATES, epochs_left = EPOCHS;
bool unlabelled, unrooted, unfinished;

c_code {
  static int hears(int a, int b) { return a != b && (graphs[now.graph] >> edge_bit(a, b) & 1); }

  static void become(struct Stage next) {
    struct Stage* old = &now.robot[now.me];
    if (memcmp(&next, old, sizeof next) == 0) return;
    now.older[now.me] = *old;
    *old = next;
    Printf("robot %d: act %d: epoch %d phase %d label %d flood parent %d%s workers %d parent %d old %d below %d%s\n", now.me, now.act, next.epoch, next.phase,
           next.label, next.flood_parent, next.flood_done ? " done" : "", next.flood_workers, next.parent, next.old_parent, next.subtree_workers,
           next.dead ? " dead" : "");
  }

  /* One step of `me`; bit k of `olds`: robot k is heard as it was. The dead may still be heard if `dead_too`. */
  static struct Stage step_of(const struct Stage* robot, const struct Stage* older, int me, unsigned olds, int dead_too, int patient, int late) {
    const struct Stage* heard[ROBOTS];
    int from[ROBOTS], count = 0;
    for (int k = 0; k < ROBOTS; ++k) {
      if (!hears(me, k) || (robot[k].dead && !(dead_too && (olds >> k & 1)))) continue;
      heard[count] = olds >> k & 1 ? &older[k] : &robot[k];
      from[count++] = k;
    }
    struct Stage r = robot[me];
    stage_step(me, &r, heard, from, count, patient, late);
    return r;
  }

  /* Rounds in which all hear each other; the root's patience ends only if somebody has died. */
  static int ends(void) {
    struct Stage robot[ROBOTS];
    memcpy(robot, now.robot, sizeof robot);
    if (robot[0].phase >= grow_tree) return 1;
    for (int round = 0; round < 24 * ROBOTS; ++round) {
      struct Stage before[ROBOTS];
      memcpy(before, robot, sizeof before);
      for (int k = 0; k < ROBOTS; ++k)
        if (!robot[k].dead) robot[k] = step_of(before, before, k, 0, 0, round % 3, k == 0 && now.deaths_left < DEATHS && round % (6 * ROBOTS) == 6 * ROBOTS - 1);
      if (robot[0].phase == grow_tree) return 1;
    }
    return 0;
  }

  static void judge(struct Stage before) {
    const struct Stage root = now.robot[0];
    const int fair = now.deaths_left == DEATHS && now.act != LATE_STEP && now.me == 0;
    if (fair && before.phase == start_tree && root.phase > start_tree)
      for (int k = 0; k < ROBOTS; ++k)
        if (now.robot[k].epoch != root.epoch || now.robot[k].label == 65535) now.unlabelled = 1;
    if (fair && now.lates_left == LATES && before.phase == start_tree + 1 && root.phase == grow_tree) {
      int at = ROBOTS - 1;
      for (int hops = 0; at > 0 && hops < ROBOTS; ++hops) at = now.robot[at].epoch == root.epoch ? now.robot[at].parent : nobody_id;
      if (at != 0) now.unrooted = 1;
    }
    if (!root.dead && !seen(now.graph + 4096ULL * (now.deaths_left < DEATHS), now.robot, sizeof now.robot) && !ends()) now.unfinished = 1;
  }

  static void take_step(void) {
    const int me = now.me;
    struct Stage r = now.robot[me];
    const struct Stage before = now.robot[0];
    unsigned olds = 0;
    if (now.old1) olds |= 1U << (me + 1) % ROBOTS;
    if (now.old2) olds |= 1U << (me + 2) % ROBOTS;
    if (now.old3) olds |= 1U << (me + 3) % ROBOTS;
    if (now.old4) olds |= 1U << (me + 4) % ROBOTS;
    if (r.dead) return;
    switch (now.act) {
      case STEP:
      case PATIENT_STEP:
        r = step_of(now.robot, now.older, me, olds, 1, now.act == PATIENT_STEP, 0);
        break;
      case LATE_STEP:
        if (me != 0 || now.lates_left == 0 || r.phase >= grow_tree) return;
        --now.lates_left;
        r = step_of(now.robot, now.older, me, olds, 1, 0, 1);
        break;
      case OPEN_EPOCH:
        if (me != 0 || now.epochs_left == 0 || r.phase != grow_tree) return;
        --now.epochs_left;
        stage_open_epoch(me, &r);
        break;
      case DIE:
        if (me == 0 || now.deaths_left == 0) return;
        --now.deaths_left;
        r.dead = 1;
        break;
    }
    become(r);
    judge(before);
  }
};

active proctype swarm() {
  atomic {
    choose_graph(graph);
    c_code {
      for (int k = 0; k < ROBOTS; ++k) {
        now.robot[k] = (struct Stage){.epoch = 65535, .label = 65535, .phase = grow_tree, .flood_parent = nobody_id, .parent = nobody_id, .old_parent = nobody_id};
        now.robot[k].worker = k == ROBOTS - 1;
        now.older[k] = now.robot[k];
      }
      now.me = 0;
      --now.epochs_left;
      struct Stage root = now.robot[0];
      stage_open_epoch(0, &root);
      now.robot[0] = root;
    }
  };
  do
  :: atomic {
    choose(me);
    if
    :: if :: old1 = 0 :: old1 = 1 fi;
       if :: old2 = 0 :: old2 = 1 fi;
#if ROBOTS > 3
       if :: old3 = 0 :: old3 = 1 fi;
#endif
#if ROBOTS > 4
       if :: old4 = 0 :: old4 = 1 fi;
#endif
       if :: act = STEP :: act = PATIENT_STEP :: act = LATE_STEP fi
    :: act = OPEN_EPOCH
    :: act = DIE
    fi;
    c_code { take_step(); };
    assert(!unlabelled);
    assert(!unrooted);
    assert(!unfinished);
    act = 0; me = 0; old1 = 0; old2 = 0; old3 = 0; old4 = 0
  }
  od
}
