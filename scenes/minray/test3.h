/* The third scene of the minimal ray tracing contest: two rows of balls, and a lamp overhead. */
#define DEPTH 3
#define SIZE 31
#define AOV 15
#define NSPHERE 7

AMBIENT = {.05, .05, .05};

/* centre, colour, radius, kd ks kt kl, ir */
SPHERE = {
    .75, 4, 0,  1, 1, 1,  .5,  .2, .8, 0, 0,  1.2,
    .65, 6, 0,  .9, .2, .9,  .5,  0, .2, .9, .05,  1.2,
    .55, 8, 0,  .2, .7, .6,  .5,  .6, .4, 0, 0,  1.2,
    -.75, 4, 0,  .7, .3, .3,  .5,  .1, .3, .7, 0,  1.4,
    -.65, 6, 0,  1, .8, .1,  .5,  .2, .8, 0, 0,  1.2,
    -.55, 8, 0,  0, 0, 1,  .5,  .5, .5, 0, 0,  1.2,
    0, 0, 3,  1, 1, 1,  2,  0, 0, 0, 1,  1.1,
};
