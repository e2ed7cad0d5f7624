/* Microwatt in system.vhd: the console, and interrupts. The processor has the functions of string.h from here, as it has no library. */

static void put_byte(uint8_t byte)
{
  *(volatile uint32_t *)CONSOLE = byte;
}

/* start.S calls these. */
void external_interrupt(void);
void exception(void);

void external_interrupt(void)
{
  const uint32_t pending = *(volatile uint32_t *)INTERRUPTS;
  take_interrupts(pending & 1, pending >> 1 & 1);
}

void exception(void)
{
  stop("an exception");
}

/* The bit EE of the state of the machine. */
static void enable_interrupts(void)
{
  uint64_t state;
  __asm__ volatile("mfmsr %0" : "=r"(state));
  __asm__ volatile("mtmsrd %0" ::"r"(state | 0x8000) : "memory");
}

void *memcpy(void *to, const void *from, size_t size)
{
  for (size_t i = 0; i < size; i++)
    ((uint8_t *)to)[i] = ((const uint8_t *)from)[i];
  return to;
}

void *memset(void *to, int byte, size_t size)
{
  for (size_t i = 0; i < size; i++)
    ((uint8_t *)to)[i] = (uint8_t)byte;
  return to;
}

int memcmp(const void *a, const void *b, size_t size)
{
  const uint8_t *x = a, *y = b;
  for (; size && *x == *y; size--)
    x++, y++;
  return size ? *x - *y : 0;
}

/* By insertion: the answers of a query are few here. */
void qsort(void *from, size_t count, size_t size, int (*compare)(const void *, const void *))
{
  uint8_t *const first = from;
  for (size_t i = 1; i < count; i++)
    for (uint8_t *at = first + i * size; at > first && compare(at - size, at) > 0; at -= size)
      for (size_t k = 0; k < size; k++) {
        const uint8_t byte = at[k];
        at[k] = at[k - size];
        at[k - size] = byte;
      }
}
