#include "efsat_retest.h"
#include <stdio.h>

/* Poses of 30 numbers in, answers out. */
int main(void)
{
  static struct efsat_retest_room room;
  double x[30];
  while (fread(x, sizeof *x, 30, stdin) == 30) {
    int answer = 9, lying = 9;
    struct efsat_retest_refusal why;
    if (efsat_retest_posed(&answer, &room, x, x + 9, x + 18, x + 27, &why))
      printf("refused %d %u\n", why.code, (unsigned)why.index);
    else if (efsat_retest_pair(&lying, &room, x, x + 9, NULL))
      return 1;
    else
      printf("%d %d\n", answer, lying);
  }
  return 0;
}
