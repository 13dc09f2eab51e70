-- Layout 7: what had been measured of the device that a session ran on.

-- Device profiles as they were when a session began, each text once.
CREATE TABLE device_profile (
  sha256 TEXT PRIMARY KEY,
  text TEXT NOT NULL
);

-- Empty: the session had none, as those of layouts before.
ALTER TABLE session ADD COLUMN device_profile_sha256 TEXT NOT NULL DEFAULT '';

CREATE TRIGGER device_profile_is_final BEFORE UPDATE ON device_profile
  BEGIN SELECT RAISE(ABORT, 'device profiles are never changed'); END;
CREATE TRIGGER device_profile_stays BEFORE DELETE ON device_profile
  BEGIN SELECT RAISE(ABORT, 'device profiles are never deleted'); END;
