/* The second scene of the minimal ray tracing contest: through a bubble that shines a little. */
#define DEPTH 4
#define SIZE 32
#define AOV 30
#define NSPHERE 3

AMBIENT = {.04, .02, .02};

/* centre, colour, radius, kd ks kt kl, ir */
SPHERE = {
    -.15, 5, 0,  1, 1, 1,  1,  0, .2, .9, .02,  1.1,
    1, 8, .3,  .7, 1, .2,  1,  .8, .2, 0, 0,  1.5,
    -3, -3, 4,  1, 1, 1,  4,  0, 0, 0, 1,  1.1,
};
