/* VexRiscv in a system by LiteX: the serial line, and interrupts. */

static void put_byte(uint8_t byte)
{
  while (*(volatile uint32_t *)UART_IS_FULL)
    ;
  *(volatile uint32_t *)UART_DATA = byte;
}

__attribute__((interrupt("machine"), used)) void trap(void)
{
  uint32_t pending, cause;
  __asm__ volatile("csrr %0, mcause" : "=r"(cause));
  if (cause >> 31 == 0)
    stop("an exception");
  __asm__ volatile("csrr %0, 0xfc0" : "=r"(pending));
  take_interrupts(pending >> PAIRS_INTERRUPT & 1, pending >> QUERIES_INTERRUPT & 1);
}

/* VexRiscv has a mask of its own beside the bits of RISC-V. */
static void enable_interrupts(void)
{
  __asm__ volatile("csrw 0xbc0, %0" ::"r"(UINT32_C(1) << PAIRS_INTERRUPT | UINT32_C(1) << QUERIES_INTERRUPT));
  __asm__ volatile("csrw mie, %0" ::"r"(0x800));
  __asm__ volatile("csrs mstatus, 8");
}
