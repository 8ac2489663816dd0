//! From bytes to findings, stage by stage: over real files, and over hostile ones.

use criterion::{BenchmarkId, Criterion, Throughput};
use edskit_benches::{Input, Stage};
use edskit_tests::hostile;
use std::time::Duration;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    real(&mut criterion);
    hostile(&mut criterion);
    criterion.final_summary();
}

/// Every stage over the same bytes.
fn real(criterion: &mut Criterion) {
    let input = Input::corpus();
    let mut group = criterion.benchmark_group("real");
    group.throughput(Throughput::Bytes(input.bytes())).sample_size(30);
    for stage in Stage::ALL {
        group.bench_function(stage.name(), |bencher| bencher.iter(|| stage.run(&input)));
    }
    group.finish();
}

/// The whole way over files made to be slow. Rates far below the others show where a file costs more than its size.
fn hostile(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("hostile");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500));
    for kind in hostile::ALL {
        let input = Input::of_file(kind.name, kind.text(1).into_bytes());
        group.throughput(Throughput::Bytes(input.bytes()));
        group.bench_with_input(BenchmarkId::new("lint", kind.what), &input, |bencher, input| {
            bencher.iter(|| Stage::Lint.run(input));
        });
    }
    group.finish();
}
