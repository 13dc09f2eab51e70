-- A session of one trial on a device whose points move by themselves.
INSERT INTO session (session, participant, protocol_sha256, seed, cells, pilot, simulated, device,
                     laboratory, program_version, realtime, rate_hz, recorded, started_time_ns)
VALUES (3, 'P03', '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '3', '', 0, 1,
        'exoskeleton', '', '0.3.0', 'simulated', 1000.0, 0, 80000000000);

INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES
  (3, 1, 'session_started', 1, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (3, 2, 'stage_entered', 1, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (3, 3, 'trials_drawn', 1, 0, 0, 1, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":2.0,"position":1,"reference_intensity":null,"repetition":1,"starting_intensity":null,"target_percent":null}]}'),
  (3, 4, 'trial_started', 1, 0, NULL, 1, 1, 0, NULL, NULL, NULL, '{}'),
  (3, 5, 'presentation_started', 1, 0, NULL, 1, 1, 0, NULL, 2.0, NULL,
   '{"interval":"test","presentation":1}'),
  (3, 6, 'presentation_ended', 1, 5000000000, NULL, 1, 1, NULL, 4999, NULL, NULL,
   '{"commanded_damping_n_s_per_m":4.25,"delivered_damping_n_s_per_m":4.0,"finger_lag_s":0.0125,"limited_ticks":7,"max_speed_m_per_s":0.5,"mean_height_m":-0.6,"num_strokes":2,"presentation":1,"stroke_width_m":0.25}'),
  (3, 7, 'trial_answered', 1, 5000000000, NULL, 1, 1, NULL, 4999, NULL, NULL,
   '{"response":80.0,"response_time_s":5.0}'),
  (3, 8, 'stage_finished', 1, 5000000000, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (3, 9, 'session_completed', 1, 5000000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}');

INSERT INTO design (session, trial, stage, block, procedure, medium, quantity, repetition, position,
                    intensity)
VALUES (3, 1, 0, 'estimation', 'magnitude_estimation', 'water', 'scale', 1, 1, 2.0);

INSERT INTO presentation (session, trial, attempt, presentation, sequence, interval, intensity,
                          first_tick, last_tick, stroke_width_m, max_speed_m_per_s, mean_height_m,
                          num_strokes, delivered_damping_n_s_per_m, commanded_damping_n_s_per_m,
                          limited_ticks, finger_lag_s)
VALUES (3, 1, 1, 1, 6, 'test', 2.0, 0, 4999, 0.25, 0.5, -0.6, 2, 4.0, 4.25, 7, 0.0125);

INSERT INTO trial (session, trial, attempt, sequence, block, procedure, medium, quantity, repetition,
                   position, intensity, response, response_time_s, num_presentations, num_steps,
                   first_tick, last_tick)
VALUES (3, 1, 1, 7, 'estimation', 'magnitude_estimation', 'water', 'scale', 1, 1, 2.0, 80.0, 5.0, 1,
        0, 0, 4999);
