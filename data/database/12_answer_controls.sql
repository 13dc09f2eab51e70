-- Layout 12: answers by pedals and buttons. Nothing of older sessions, in which nobody kept who answered.

-- participant or experimenter; '' of simulated participants.
ALTER TABLE trial ADD COLUMN answered_by TEXT NOT NULL DEFAULT '';
-- The device and its control; '' for the window's keys and buttons.
ALTER TABLE trial ADD COLUMN control TEXT NOT NULL DEFAULT '';
-- When it was pressed, s of CLOCK_MONOTONIC.
ALTER TABLE trial ADD COLUMN control_monotonic_s REAL;
