//! `adapters`: the GPUs that runs can use.

use super::{CliError, print};
use crate::engine::AdapterInfo;
use crate::gpu::adapter;

pub(super) fn adapters() -> Result<(), CliError> {
    let found = adapter::list();
    if found.is_empty() {
        // The line that a run would end with says what to install.
        adapter::choose(None)?;
    }
    for candidate in found {
        let AdapterInfo { name, backend, driver, driver_info, software } = &candidate.info;
        let kind = if *software { "software" } else { "hardware" };
        let precision = if candidate.double_precision { "f32, f64" } else { "f32" };
        print(format_args!("{name}: {kind}, {backend}, {precision}, {driver} {driver_info}"))?;
    }
    Ok(())
}
