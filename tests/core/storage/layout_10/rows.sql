-- A look at two sessions, after which the study went on, and somebody who opened the results.
INSERT INTO sequential_look (look, decision, time_ns, program_version)
VALUES (1, 'go_on', 210000000000, '0.10.0');
INSERT INTO sequential_look_session (look, session) VALUES (1, 3), (1, 4);
INSERT INTO unsealing (time_ns, num_complete, reason) VALUES (220000000000, 2, 'a visit');
