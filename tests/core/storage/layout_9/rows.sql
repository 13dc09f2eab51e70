-- Session 7: a trial of three intervals, of which the second was the odd one and was chosen.
INSERT INTO session (session, participant, protocol_sha256, seed, cells, pilot, simulated, device,
                     laboratory, program_version, realtime, rate_hz, recorded, started_time_ns)
VALUES (7, 'P07', '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '7', '', 0, 1,
        'lumped', '', '0.9.0', 'simulated', 1000.0, 0, 200000000000);

INSERT INTO event (session, sequence, kind, version, time_ns, stage, trial, attempt, first_tick,
                   last_tick, intensity, supersedes, data)
VALUES
  (7, 1, 'session_started', 1, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (7, 2, 'stage_entered', 1, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (7, 3, 'trials_drawn', 1, 0, 0, 1, NULL, NULL, NULL, NULL, NULL,
   '{"trials":[{"intensity":2.0,"intervals":"rtr","position":1,"reference_intensity":1.0,"repetition":1,"right_interval":2,"starting_intensity":null,"target_percent":null}]}'),
  (7, 4, 'trial_started', 1, 0, NULL, 1, 1, 0, NULL, NULL, NULL, '{}'),
  (7, 5, 'trial_answered', 1, 3000000000, NULL, 1, 1, NULL, 2999, NULL, NULL,
   '{"chosen_interval":2,"response":1.0,"response_time_s":3.0}'),
  (7, 6, 'stage_finished', 1, 3000000000, 0, NULL, NULL, NULL, NULL, NULL, NULL, '{}'),
  (7, 7, 'session_completed', 1, 3000000000, NULL, NULL, NULL, NULL, NULL, NULL, NULL, '{}');

INSERT INTO design (session, trial, stage, block, procedure, medium, quantity, repetition, position,
                    intensity, reference_intensity, sequence, is_catch, intervals, right_interval)
VALUES (7, 1, 0, 'oddity', 'constant_stimuli', 'viscous', 'viscosity_pa_s', 1, 1, 2.0, 1.0, 3, 0,
        'rtr', 2);

INSERT INTO trial (session, trial, attempt, sequence, block, procedure, medium, quantity, repetition,
                   position, intensity, reference_intensity, response, response_time_s,
                   num_presentations, num_steps, first_tick, last_tick, is_catch, intervals,
                   right_interval, chosen_interval)
VALUES (7, 1, 1, 5, 'oddity', 'constant_stimuli', 'viscous', 'viscosity_pa_s', 1, 1, 2.0, 1.0, 1.0, 3.0,
        0, 0, 0, 2999, 0, 'rtr', 2, 2);
