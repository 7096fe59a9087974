"""Documents for paper and screen: one model, several writers."""
