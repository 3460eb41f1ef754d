/* SPDX-License-Identifier: MIT */
/* Caravan's rules, as the models caravan_*.pml call them. Each function puts one robot on a bench, with what the model
   lets it remember and hear, and makes it take one step(): the whole round of a robot. Nothing is decided here. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

enum { no_robot = -1, largest_caravan = 8 };
enum { is_put_off = -2, is_vacant = -3 }; /* instead of a target's holder */

/* A swarm in which nothing goes wrong any more: whole robots, which all hear their neighbours in each round. They are
   put in one by one by caravan_place_*(), and read by caravan_read_*(). */
void caravan_round(int count, int (*hears)(int, int), unsigned dead);

/* caravan_order.pml: a robot's place in the order. */
struct Place {
  unsigned short sequence, beat;
  unsigned short newest_sequence; /* of the root that it has heard of */
  signed char root, newest, parent, unused;
};

int caravan_is_ahead(const struct Place* self, const struct Place* heard);
/* -1, 0, 1: as the pair of `a` is behind, the same, ahead. */
int caravan_compare(const struct Place* a, const struct Place* b);
/* A round in which `id` alone is heard, -1: nobody. */
enum Likes {
  far_away,
  cheapest,  /* near, and the present parent is silent */
};
void caravan_order_step(int me, struct Place* self, int id, const struct Place* heard, const struct Place* parent, int likes);
/* The parent has been silent until it was forgotten. */
void caravan_order_lose(int me, struct Place* self);
/* The root has been silent for long, and was near. */
void caravan_order_claim(int me, struct Place* self);
void caravan_place_order(int me, const struct Place* self);
void caravan_read_order(int me, struct Place* self);

/* caravan_promise.pml: a robot that may be an end of links, and what it remembers of the two others. */
struct Remembered {
  unsigned char age, sequence; /* forgotten: 255 */
  signed char parent, other, root;
  signed char beat; /* how far it is behind the newest: 0 or less */
};
struct End {
  unsigned char sequence, newest_sequence, other_rounds, dead;
  signed char root, newest, parent, other;
  signed char beat, unused;
  struct Remembered of[4];
};
enum { caravan_lease = 2 };

/* A round in which all of `heard` are heard; robot `near` is near, the others are far. */
void caravan_promise_step(int me, struct End* self, const struct End* const* heard, const int* from, int count, int near);
int caravan_is_promised(int me, const struct End* self, int id);

/* caravan_token.pml: the root's token and a target's, as a robot knows and sends them. */
struct Holding {
  unsigned short sequence, beat;
  signed char root, holder;
  unsigned char serving, reached, dead, unfit;
  unsigned char busy, unused; /* with another target */
};
struct Events {
  unsigned char beats;          /* rounds that the step stands for */
  unsigned char root_silent;    /* the root has not been heard of for longer than its successor waits */
  unsigned char holder_silent;  /* nor the holder of the target; or it has been without one for so long */
  unsigned char child_silent;   /* the holder is my child, and it is so long since I heard it */
  unsigned char waits_in_vain;  /* the holder, for spares */
  unsigned char drives_in_vain; /* it has come no nearer, though nothing held it back */
  unsigned char leaving;        /* the battery runs low */
  unsigned char gives_up;       /* the mission tells it to give up the target that it holds */
  unsigned char offered;        /* the sender is a root that runs low, and offers its token to me */
};

/* `first` is the robot first sent to the target, `there` the one that stands in it, -1: nobody. */
void caravan_token_step(int me, struct Holding* self, int id, const struct Holding* heard, struct Events events, int first, int there);
int caravan_ahead_by(unsigned short a, unsigned short b);
void caravan_place_token(int me, const struct Holding* self, int first, int there);
void caravan_read_token(int me, struct Holding* self, int first);
int caravan_is_spare(int me);

/* caravan_post.pml: the call as a robot knows and sends it. */
struct Post {
  signed char source, ended_source;
  unsigned char count, hops, silence, ended_count, own_count;
  unsigned char calls, dead, unused;
};

void caravan_post_step(int me, struct Post* self, const struct Post* const* heard, const int* from, int count);

#ifdef __cplusplus
}
#endif
