use super::*;

/// The 16-bit words of a frame.
fn words(frame: &edskit_runtime::Frame) -> Vec<u16> {
    frame.data().chunks(2).map(|word| u16::from_le_bytes(word.try_into().unwrap())).collect()
}

/// The distances of times.
fn distances(times: &[u64]) -> Vec<u64> {
    times.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

// GW-TIMING-02, GW-TIMING-03, GW-TIMING-04, GW-TIMING-05, GW-TIMING-06, GW-TIMING-08, GW-CFG-03
#[test]
fn the_cycle_times_of_the_manual() {
    let settings = [example(16, 100), governor(&[(16408, 2000), (16462, 200)]), gateway(&[(16405, 0x190)])];
    let mut bench = Bench::started(&settings.concat());
    let sent = bench.pass(10_000_000);
    for (can_id, cycle) in [(0x481, 15_625), (0x190, 187_500), (0x57F, 93_750)] {
        let times: Vec<u64> =
            sent.iter().filter(|(_, frame)| frame.can_id().raw() == can_id).map(|(time, _)| *time).collect();
        assert!((times.len() as u64).abs_diff(10_000_000 / cycle) <= 1, "{can_id:X}h: {}", times.len());
        assert!(distances(&times).iter().all(|distance| *distance == cycle), "{can_id:X}h: {times:?}");
    }
    assert!(sent.iter().all(|(_, frame)| [0x481, 0x190, 0x57F].contains(&frame.can_id().raw())));
}

// GW-TIMING-05, GW-TIMING-07, GW-NOTE-06, GW-NOTE-08
#[test]
fn the_shortest_and_the_longest_cycle() {
    for (setting, cycle) in [
        (1, DC),
        (15, DC),
        (31, DC),
        (32, 2 * DC),
        (3984, 254 * DC),
        (3985, 255 * DC),
        (4000, 255 * DC),
        (65_535, 255 * DC),
    ] {
        let mut bench = Bench::started(&example(setting, 0));
        let times = bench.times_of(0x481, 2 * 3_984_375 + cycle);
        assert!(times.len() >= 3, "{setting} ms");
        assert!(distances(&times).iter().all(|distance| *distance == cycle), "{setting} ms");
    }
}

// GW-PDO-04, GW-PDO-08, GW-PDO-09, GW-PDO-10, GW-PDO-11, GW-NMT-14
#[test]
fn the_words_of_the_manual() {
    let mut bench = Bench::new(&example(100, 100));
    assert_eq!(bench.times_of(0x481, 1_000_000), [], "only in operational");
    bench.gateway.governor_mut().set_load(500);
    bench.nmt(1);
    let sent = bench.pass(30 * 6 * DC);
    let last = |can_id| sent.iter().rfind(|(_, frame)| frame.can_id().raw() == can_id).unwrap().1;
    let engine = bench.gateway.governor();
    let values = |numbers: &[u16]| numbers.iter().map(|number| engine.value(*number)).collect::<Vec<_>>();
    assert_eq!(words(&last(0x481)), values(&[2000, 2031, 2300, 2330]));
    assert_eq!(words(&last(0x57F)), values(&[2905, 2908, 2917]));
    assert!(words(&last(0x481)).iter().all(|word| *word > 0), "the engine runs");
    let active = bench.gateway.pdos().unwrap().tpdos.iter().filter(|tpdo| tpdo.activity.is_active());
    assert_eq!(active.map(|tpdo| tpdo.number).collect::<Vec<_>>(), [4, 16], "those between have no content");
    // 0, what does not exist and what is no value are left out, and the rest moves up.
    for second in [0, 9999, 3070] {
        let settings = [example(16, 0), governor(&[(16401, second)])].concat();
        let mut bench = Bench::started(&settings);
        let sent = bench.pass(DC);
        let engine = bench.gateway.governor();
        assert_eq!(sent[0].1.data().len(), 6);
        assert_eq!(words(&sent[0].1), [2000, 2300, 2330].map(|number| engine.value(number)));
    }
}

// GW-PDO-02, GW-PDO-03, GW-PDO-01, GW-CFG-01, GW-CFG-02, GW-TIMING-01, GW-GAP-10
#[test]
fn errors_and_status_are_sent_when_they_change() {
    let mut bench = Bench::started(&governor(&[(14401, 1), (14402, 1)]));
    let first = bench.pass(10 * DC);
    let lengths: Vec<_> = first.iter().map(|(_, frame)| (frame.can_id().raw(), frame.data().len())).collect();
    assert_eq!(lengths[..3], [(0x181, 8), (0x281, 4), (0x381, 2)], "once on entry");
    assert_eq!(
        first[..3].iter().map(|(time, _)| *time).collect::<Vec<_>>(),
        [DC; 3],
        "in the next main cycle"
    );
    // Within one main cycle an error comes, goes and comes: one frame tells it.
    let times = |bench: &mut Bench| bench.times_of(0x181, 100 * DC);
    bench.pass(60_000_000);
    bench.gateway.governor_mut().set_error(3001, true);
    bench.gateway.governor_mut().set_error(3001, false);
    bench.gateway.governor_mut().set_error(3001, true);
    let sent = bench.pass(100 * DC);
    let errors: Vec<_> = sent.iter().filter(|(_, frame)| frame.can_id().raw() == 0x181).collect();
    assert_eq!((errors.len(), errors[0].1.data()), (1, &[2, 0, 0, 0, 0, 0, 0, 0][..]));
    assert_eq!(times(&mut bench), [], "nothing changes, nothing is sent");
    // It comes and goes between two main cycles: nothing has changed when the governor looks.
    bench.gateway.governor_mut().set_error(3002, true);
    bench.gateway.governor_mut().set_error(3002, false);
    assert_eq!(times(&mut bench), []);
    // Every main cycle another error: one frame in each.
    let mut count = 0;
    for cycle in 0..50 {
        bench.gateway.governor_mut().set_error(3003, cycle % 2 == 0);
        count += bench.times_of(0x181, DC).len();
    }
    assert_eq!(count, 50);
    // Errors 64 to 95 are in TPDO 2: 3085 ErrVoltage is bit 5 of its second word.
    let now = bench.now;
    bench.gateway.set_supply(now, 7_000);
    let sent = bench.pass(DC);
    assert_eq!((sent[0].1.can_id().raw(), sent[0].1.data()), (0x281, &[0, 0, 0x20, 0][..]));
}

// GW-CFG-02
#[test]
fn errors_without_status() {
    let mut bench = Bench::started(&governor(&[(14401, 1)]));
    let sent = bench.pass(1_000_000);
    assert_eq!(sent.iter().map(|(_, frame)| frame.can_id().raw()).collect::<Vec<_>>(), [0x181, 0x281]);
    assert_eq!(bench.read(0x2000, 0), Ok(6));
}

// GW-GAP-10, GW-NOTE-46, GW-TIMING-01
#[test]
fn operational_again_sends_what_has_changed() {
    for command in [128, 2] {
        let mut bench = Bench::started(&governor(&[(14401, 1), (14402, 1)]));
        bench.pass(60_000_000);
        let again = |bench: &mut Bench| {
            bench.nmt(command);
            assert_eq!(bench.pass(1_000_000), []);
            bench.nmt(1);
            let sent = bench.pass(1_000_000);
            sent.iter().map(|(_, frame)| frame.can_id().raw()).collect::<Vec<_>>()
        };
        assert_eq!(again(&mut bench), [], "nothing has changed");
        bench.nmt(command);
        bench.gateway.governor_mut().set_error(3001, true);
        assert_eq!(
            again(&mut bench),
            [0x181, 0x381],
            "an error, and the status that shows that there is one"
        );
        // It comes and goes while nothing may be sent.
        bench.nmt(command);
        bench.gateway.governor_mut().set_error(3002, true);
        bench.pass(1_000_000);
        bench.gateway.governor_mut().set_error(3002, false);
        assert_eq!(again(&mut bench), []);
        assert_eq!(again(&mut bench), []);
    }
}

// GW-GAP-10, GW-NOTE-46
#[test]
fn every_initialisation_is_followed_by_everything() {
    let all = [0x181, 0x281, 0x381];
    let mut bench = Bench::started(&governor(&[(14401, 1), (14402, 1)]));
    bench.pass(60_000_000);
    let first = |bench: &mut Bench| {
        bench.pass(300_000);
        bench.nmt(1);
        let sent = bench.pass(DC);
        sent.iter().map(|(_, frame)| frame.can_id().raw()).collect::<Vec<_>>()
    };
    bench.nmt(129);
    assert_eq!(first(&mut bench), all, "by the master");
    let now = bench.now;
    assert!(bench.gateway.command(now, State::Init));
    assert_eq!(first(&mut bench), all, "by the governor");
    for unit in [Owner::Gateway, Owner::Governor] {
        let now = bench.now;
        bench.gateway.reset(now, unit);
        assert_eq!(first(&mut bench), all, "after a reset of {unit:?}");
    }
    for fault in [Fault::ReceiveBuffer2, Fault::CanOpenBuffer1] {
        let now = bench.now;
        bench.gateway.inject(now, fault);
        assert_eq!(first(&mut bench), all, "after {fault:?}");
    }
}

// GW-PDO-05, GW-PDO-08, GW-PDO-19
#[test]
fn bits_of_the_governor_are_left_out() {
    let settings = governor(&[(16404, 2000), (16405, 12401), (16406, 3074), (16407, 14401), (16461, 100)]);
    let mut bench = Bench::started(&[settings, gateway(&[(16404, 0x1C5)])].concat());
    let sent = bench.pass(6 * DC);
    let of_5 = sent.iter().find(|(_, frame)| frame.can_id().raw() == 0x1C5).unwrap();
    assert_eq!(of_5.1.data().len(), 2);
    // A TPDO of bits alone is not active, so that its identifier is in nobody's way.
    let settings = governor(&[(16404, 12401), (16405, 4406), (16406, 14402), (16407, 3005), (16461, 100)]);
    let mut bench = Bench::started(&[settings, gateway(&[(16404, 0x080)])].concat());
    assert_eq!(bench.pass(1_000_000), []);
}

// GW-PDO-19, GW-PDO-06, GW-PDO-07
#[test]
fn parameters_of_the_governor_are_sent_with_their_values() {
    let settings =
        [(16400, 827), (16401, 400), (16402, 16460), (16403, 401), (16460, 16), (827, -5), (401, 1)];
    let mut bench = Bench::started(&governor(&settings));
    bench.pass(DC);
    // -5 has a sign, so that it is in 2002h; 1.0 s are 100 steps of 10 ms.
    assert_eq!(bench.read(0x2002, 1), Ok(0xFFFB));
    assert_eq!([1, 2, 3].map(|sub_index| bench.read(0x2001, sub_index)), [Ok(100), Ok(16), Ok(1)]);
}

// GW-PDO-05, GW-PDO-06, GW-NOTE-03
#[test]
fn signed_and_unsigned_words_are_counted_apart() {
    let settings =
        both(&[(16404, 0x190)], &[(16400, 2908), (16401, 2000), (16404, 2908), (16460, 16), (16461, 16)]);
    let mut bench = Bench::started(&settings);
    bench.gateway.governor_mut().set_load(300);
    bench.pass(DC);
    let temperature = bench.gateway.governor().value(2908);
    assert_eq!((bench.read(0x2002, 0), bench.read(0x2001, 0)), (Ok(2), Ok(1)));
    assert_eq!(bench.read(0x2002, 2), Ok(temperature.into()));
    assert_eq!((bench.read(0x1A03, 1), bench.read(0x1A03, 2)), (Ok(0x2002_0110), Ok(0x2001_0110)));
    assert_eq!(bench.read(0x1A04, 1), Ok(0x2002_0210));
}
