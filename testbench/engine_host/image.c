#include "efsat_engine_image.h"
#include <stdio.h>
#include <stdlib.h>

/* Images in, each behind its size as text; what is refused out, and the byte. */
int main(void)
{
  unsigned size;
  while (scanf("%u", &size) == 1 && getchar() == '\n') {
    /* Room of just the size, so that nothing beyond it is read unnoticed. */
    uint8_t *const bytes = malloc(size ? size : 1);
    struct efsat_engine_image image;
    struct efsat_engine_refusal why;
    int refused;
    if (!bytes || fread(bytes, 1, size, stdin) != size)
      return 1;
    refused = efsat_engine_read_image(&image, bytes, size, &why);
    if (!refused) {
      uint32_t *const scratch = malloc(EFSAT_ENGINE_SCRATCH_WORDS(image.triangles) * sizeof *scratch);
      if (!scratch)
        return 1;
      refused = efsat_engine_check_image(&image, scratch, &why);
      free(scratch);
    }
    if (refused && why.index == EFSAT_ENGINE_NO_INDEX)
      printf("size\n");
    else if (refused)
      printf("%u\n", (unsigned)why.index);
    else
      printf("taken\n");
    free(bytes);
  }
  return 0;
}
