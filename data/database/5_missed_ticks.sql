-- Layout 5: ticks of the haptic loop that were due during a presentation and never ran. In older
-- sessions their time is missing from the ticks, and how many they were is not known.

ALTER TABLE presentation ADD COLUMN missed_ticks INTEGER NOT NULL DEFAULT 0;
