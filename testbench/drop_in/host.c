#include <inttypes.h>
#include <stdio.h>
#include "efsat.h"

static void print(const uint8_t *bytes, unsigned count)
{
  for (unsigned i = 0; i < count; i++)
    printf("%02x", bytes[i]);
  printf("\n");
}

static void print_answer(const struct efsat_answer *a)
{
  printf("%u %u %u %u %" PRIu64 " %" PRIu32 " %" PRIu32 "\n", a->verdict, a->reason, a->outside, a->malformed, a->tag,
      a->separated, a->overlapping);
}

int main(void)
{
  char kind;
  long long tag, sticky, number;
  while (scanf(" %c %lld %lld", &kind, &tag, &sticky) == 3) {
    int64_t numbers[200] = {0};
    uint8_t word[EFSAT_WORD_BYTES], pair[EFSAT_PAIR_BYTES], answer[EFSAT_ANSWER_BYTES * 8];
    char text[EFSAT_EXPLANATION];
    struct efsat_refusal why;
    const unsigned count = kind == 'd' ? (unsigned)(tag + sticky) : 18;
    (void)tag, (void)sticky;
    for (unsigned i = 0; i < count && scanf("%lld", &number) == 1; i++)
      numbers[i] = number;
    if (kind == 'p') {
      if (efsat_put_pair(pair TAG STICKY, numbers, &why)) {
        printf("%s\n", efsat_explain(&why, text));
        continue;
      }
      efsat_put_header(word, EFSAT_PAIRS_HEADER);
      print(word, sizeof word);
      print(pair, sizeof pair);
    }
#ifdef EFSAT_POSE_WORDS
    if (kind == 'm') {
      uint8_t pose[EFSAT_POSE_BYTES];
      if (efsat_put_pose(pose, tag == 1 STICKY, numbers, &why)) {
        printf("%s\n", efsat_explain(&why, text));
        continue;
      }
      efsat_put_header(word, EFSAT_POSE_HEADER);
      print(word, sizeof word);
      print(pose, sizeof pose);
    }
#endif
    if (kind == 'a') {
      struct efsat_answer a;
      for (unsigned i = 0; i < EFSAT_ANSWER_BYTES; i++)
        answer[i] = (uint8_t)numbers[i];
      if (efsat_get_answer(&a, answer, NULL))
        printf("refused\n");
      else
        print_answer(&a);
    }
    if (kind == 'd') {
      struct efsat_answer answers[8];
      for (unsigned i = 0; i < sticky; i++)
        answer[i] = (uint8_t)numbers[tag + i];
#ifdef EFSAT_RECORD_TAG_LOW
      uint64_t tags[8];
      for (unsigned i = 0; i < tag; i++)
        tags[i] = (uint64_t)numbers[i];
      if (efsat_get_answers(answers, (uint32_t)tag, tags, answer, (size_t)sticky, &why))
#else
      if (efsat_get_answers(answers, (uint32_t)tag, answer, (size_t)sticky, &why))
#endif
        printf("%s\n", answers[0].verdict == EFSAT_VERDICT_REPORT && answers[tag - 1].malformed ? "refused" : "left over");
      else
        for (unsigned i = 0; i < tag; i++)
          print_answer(&answers[i]);
    }
  }
}
