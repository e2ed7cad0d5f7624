/* Where things are in system.vhd. */
#define PAIRS_BASE 0xc0000000
#define QUERIES_BASE 0xc0001000
#define INTERRUPTS 0xc0002000
#define CONSOLE 0xc0002000
