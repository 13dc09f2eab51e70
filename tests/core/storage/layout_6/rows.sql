-- Two exports, a withdrawal that has reached every backup, and an adverse event.
INSERT INTO export (export, place, kind, time_ns)
VALUES (1, '/exports/first_csv', 'csv', 110000000000),
       (2, '/exports/report', 'report', 120000000000);

INSERT INTO export_session (export, session) VALUES (1, 1), (1, 3), (2, 5);

INSERT INTO withdrawal_step (step, participant, state, time_ns)
VALUES (1, 'P02', 'begun', 130000000000),
       (2, 'P02', 'erased', 130000000001),
       (3, 'P02', 'finished', 130000000002);

INSERT INTO adverse_event (adverse_event, session, participant, time_ns, text)
VALUES (1, 5, 'P05', 140000000000, 'a pinched finger');
