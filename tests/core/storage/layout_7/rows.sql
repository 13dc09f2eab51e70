-- Session 6 ran on a device that had been measured before.
INSERT INTO device_profile (sha256, text)
VALUES ('44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '{}');

INSERT INTO session (session, participant, protocol_sha256, seed, cells, pilot, simulated, device,
                     laboratory, program_version, realtime, rate_hz, recorded, started_time_ns,
                     device_profile_sha256)
VALUES (6, 'P06', '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '6', '', 0, 1,
        'lumped', '', '0.7.0', 'simulated', 1000.0, 0, 150000000000,
        '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a');

INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES
  (6, 1, 'session_started', 1, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (6, 2, 'session_ended_early', 1, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
   '{"reason":"the hand was cold"}');
