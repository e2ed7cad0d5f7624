//! Software triangle tests: those that the paper and its users compare with, and the exact retest.
