/* The functions of efsat_registers.h against a model of the queues, which ends the program at an access that the hardware refuses. A
 * core between the queues hands words on, a few at a time. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t load(uintptr_t base, unsigned offset);
static void store(uintptr_t base, unsigned offset, uint32_t value);
#define EFSAT_REGISTERS_READ(base, offset) load(base, offset)
#define EFSAT_REGISTERS_WRITE(base, offset, value) store(base, offset, value)
#include "efsat_registers.h"

enum { PLACES = 64, BASE = 0x4000 };
struct queue {
  uint32_t low[PLACES], high[PLACES], last[PLACES];
  unsigned from, level;
};
static struct queue sent, received;
static uint32_t held, control;

static void expect(int condition, const char *what)
{
  if (!condition) {
    printf("refused: %s\n", what);
    exit(1);
  }
}

static void push(struct queue *queue, uint32_t low, uint32_t high, uint32_t last)
{
  unsigned at = (queue->from + queue->level) % PLACES;
  expect(queue->level < PLACES, "full");
  queue->low[at] = low;
  queue->high[at] = high;
  queue->last[at] = last;
  queue->level++;
}

static void pop(struct queue *queue)
{
  queue->from = (queue->from + 1) % PLACES;
  queue->level--;
}

static uint32_t load(uintptr_t base, unsigned offset)
{
  unsigned at = received.from;
  uint32_t high;
  expect(base == BASE, "base");
  switch (offset) {
  case EFSAT_REGISTERS_IDENTITY:
    return EFSAT_REGISTERS_IDENTITY_RESET;
  case EFSAT_REGISTERS_VERSION:
    return EFSAT_REGISTERS_VERSION_RESET;
  case EFSAT_REGISTERS_PARAMETERS:
    return EFSAT_REGISTERS_PARAMETERS_RESET;
  case EFSAT_REGISTERS_CORE:
    return EFSAT_REGISTERS_CORE_RESET;
  case EFSAT_REGISTERS_STATUS:
    return sent.level | received.level << 8 | (received.level ? received.last[at] << 16 : 0);
  case EFSAT_REGISTERS_RECEIVE_LOW:
    expect(received.level > 0, "empty");
    return received.low[at];
  case EFSAT_REGISTERS_RECEIVE_HIGH:
    expect(received.level > 0, "empty");
    high = received.high[at];
    pop(&received);
    return high;
  default:
    expect(0, "address");
    return 0;
  }
}

static void store(uintptr_t base, unsigned offset, uint32_t value)
{
  expect(base == BASE, "base");
  if (offset == EFSAT_REGISTERS_TRANSMIT_LOW)
    held = value;
  else if (offset == EFSAT_REGISTERS_TRANSMIT_HIGH)
    push(&sent, held, value, 0);
  else if (offset == EFSAT_REGISTERS_TRANSMIT_LAST)
    push(&sent, held, value, 1);
  else if (offset == EFSAT_REGISTERS_CONTROL)
    control = value;
  else
    expect(0, "address");
}

static void work(unsigned words)
{
  for (; (control & 1) && words > 0 && sent.level > 0 && received.level < PLACES; words--) {
    push(&received, sent.low[sent.from], sent.high[sent.from], sent.last[sent.from]);
    pop(&sent);
  }
}

int main(void)
{
  static uint8_t packet[8 * 200], answer[8 * 200];
  unsigned seed = 1;
  expect(efsat_registers_fit(BASE), "another design");
  efsat_registers_reset(BASE, 1);
  expect(control == 3, "control");
  for (unsigned words = 1; words <= 200; words++) {
    size_t size = 8 * words, done = 0, come = 0;
    int ended = 0;
    for (size_t i = 0; i < size; i++)
      packet[i] = (uint8_t)(seed = seed * 1103515245u + 12345u, seed >> 16);
    while (!ended) {
      if (done < size)
        done += efsat_registers_send(BASE, packet + done, size - done, 1);
      work(seed % 7 + 1);
      seed = seed * 1103515245u + 12345u;
      come += efsat_registers_receive(BASE, answer + come, sizeof answer - come, &ended);
    }
    expect(done == size && come == size && memcmp(packet, answer, size) == 0, "other words");
    expect(sent.level == 0 && received.level == 0, "words are left");
  }
  puts("200 packets, all as sent");
  return 0;
}
