"""Which effects a scene calls for, why, and what the others are worth."""
