"""What each calculator command answers: a scene in, a report out."""
