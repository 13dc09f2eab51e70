-- Layout 3: who leads, the palm or the fingers.

-- By how much thumb, index and middle trail behind the palm; < 0: they lead. Nothing of a device
-- whose points move as one, nor of sessions before this layout.
ALTER TABLE presentation ADD COLUMN finger_lag_s REAL;
