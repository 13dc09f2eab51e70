-- How many are planned, an appointment, and a note that somebody has read.
INSERT INTO planned_number (num_participants, time_ns) VALUES (12, 250000000000);
INSERT INTO appointment (appointment, participant, starts_time_ns, cancelled, time_ns)
VALUES (1, 'P11', 900000000000, 0, 250000000000);
INSERT INTO acknowledgement (adverse_event, time_ns) VALUES (1, 250000000000);

-- Session 10: a person, whose start was not kept. A questionnaire came after each of two stages.
INSERT INTO session (session, participant, protocol_sha256, seed, cells, pilot, simulated, device,
                     laboratory, program_version, realtime, rate_hz, recorded, started_time_ns)
VALUES (10, 'P10', '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '10', '', 0, 0,
        'lumped', '', '0.13.0', 'real-time thread', 1000.0, 0, 0);

INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES
  (10, 1, 'session_started', 1, 260000000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
   '{"fields":{"sex":"female"}}'),
  (10, 2, 'stage_entered', 1, 261000000000, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (10, 3, 'item_answered', 1, 262000000000, 0, NULL, NULL, NULL, NULL, NULL, NULL,
   '{"answer":"2","item":"tired","stage_name":"rest"}'),
  (10, 4, 'stage_finished', 1, 263000000000, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (10, 5, 'stage_entered', 1, 264000000000, 1, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (10, 6, 'item_answered', 1, 265000000000, 1, NULL, NULL, NULL, NULL, NULL, NULL,
   '{"answer":"4","item":"tired","stage_name":"rest"}'),
  (10, 7, 'item_answered', 1, 266000000000, 1, NULL, NULL, NULL, NULL, NULL, NULL,
   '{"answer":"5","item":"tired","stage_name":"rest"}'),
  (10, 8, 'session_ended_early', 1, 267000000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
   '{"reason":"enough"}');

INSERT INTO answer (session, sequence, stage, item, answer)
VALUES
  (10, 1, 'participant', 'sex', 'female'),
  (10, 3, 'rest', 'tired', '2'),
  (10, 6, 'rest', 'tired', '4'),
  (10, 7, 'rest', 'tired', '5');
