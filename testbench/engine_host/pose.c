#include "efsat_engine_pose.h"
#include <stdio.h>

static const uint8_t *file(uint8_t *bytes, size_t room, size_t *size, const char *name)
{
  FILE *const from = fopen(name, "rb");
  if (!from)
    return NULL;
  *size = fread(bytes, 1, room, from);
  fclose(from);
  return bytes;
}

/* Poses of 12 numbers in; a code, an index and the words of the packet out. */
int main(int count, char **names)
{
  static uint8_t bytes[2][1 << 20];
  static uint32_t scratch[1 << 16];
  static struct efsat_retest_room room;
  static const int codes[] = {0, EFSAT_ENGINE_REFUSED_NOT_FINITE, EFSAT_ENGINE_REFUSED_SCALE, EFSAT_ENGINE_REFUSED_ENTRY,
    EFSAT_ENGINE_REFUSED_TRANSLATION, REST};
  struct efsat_engine_image images[2];
  const struct efsat_engine_image *const both[2] = {&images[0], &images[1]};
  double x[12];
  for (int i = 0; i < 2; i++) {
    size_t size = 0;
    if (count != 3 || !file(bytes[i], sizeof bytes[i], &size, names[1 + i])
        || efsat_engine_read_image(&images[i], bytes[i], size, NULL) || efsat_engine_check_image(&images[i], scratch, NULL))
      return 1;
  }
  while (fread(x, sizeof *x, 12, stdin) == 12) {
    static struct ASKED asked;
    static uint64_t packet[WORDS];
    uint32_t head[2] = {9, 0}, next = 5;
    struct efsat_engine_refusal why;
    const int refused = efsat_engine_put_pose(&asked, &room, both, x, x + 9, &why);
    for (uint32_t i = 0; i < sizeof codes / sizeof *codes; i++)
      if (codes[i] == refused)
        head[0] = i;
    if (refused)
      head[1] = why.index;
    for (unsigned i = 0; i < 2; i++)
      asked.sides[i] = SIDE;
    if (!refused && PUT(packet, &asked, &next, &why))
      return 2;
    fwrite(head, sizeof *head, 2, stdout);
    if (!refused)
      fwrite(packet, sizeof *packet, WORDS, stdout);
  }
  return 0;
}
