/* The first scene of the minimal ray tracing contest: a glass ball before two others. */
#define DEPTH 3
#define SIZE 32
#define AOV 25
#define NSPHERE 5

AMBIENT = {.02, .02, .02};

/* centre, colour, radius, kd ks kt kl, ir */
SPHERE = {
    0, 6, .5,  1, 1, 1,  .9,  .05, .2, .85, 0,  1.7,
    -1, 8, -.5,  1, .5, .2,  1,  .7, .3, 0, .05,  1.2,
    1, 8, -.5,  .1, .8, .8,  1,  .3, .7, 0, 0,  1.2,
    3, -6, 15,  1, .8, 1,  7,  0, 0, 0, .6,  1.5,
    -3, -3, 12,  .8, 1, 1,  5,  0, 0, 0, .5,  1.5,
};
