/* SPDX-License-Identifier: MIT */
/* The sizes of a swarm, for Promela and for the C within it. */
#ifndef ROBOTS
#define ROBOTS 3
#endif
#ifndef COPIES
#define COPIES 1  /* older values of a robot that may still be heard, beside the newest */
#endif
