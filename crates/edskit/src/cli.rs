//! The command line's grammar.

mod live;

pub(crate) use live::{
    BusArguments, MonitorArguments, NmtArguments, NmtTarget, ReadFormat, RunArguments, SdoArguments,
    SdoCommand, SdoPlaceArguments, SdoReadArguments, SdoWriteArguments, TransferKind,
};

use crate::files;
use clap::builder::{NonEmptyStringValueParser, OsStringValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use clap_complete::Shell;
use edskit_lint::Severity;
use edskit_types::NodeId;
use std::path::PathBuf;

/// Lint, format, read and run CANopen EDS and DCF files (CiA 306), and talk to devices on a bus (CiA 301).
#[derive(Parser, Debug)]
#[command(name = "edskit", version, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 clean, 1 findings, 2 something could not be done.")]
pub struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Check EDS, DCF and nodelist.cpj files
    Lint(LintArguments),
    /// Bring EDS, DCF and nodelist.cpj files into their canonical form
    Fmt(FmtArguments),
    /// Show the device that a file describes, one object, or one entry
    Show(ShowArguments),
    /// Check parameter files of devices
    Config(ConfigArguments),
    /// Generate the object dictionary of a device in Rust
    ///
    /// The same as `edskit_codegen::compile` in a build script, with one file as its result. What an EDS cannot say stands
    /// in a side-file beside it (Device.toml for Device.eds); docs/generating.md describes both.
    Generate(GenerateArguments),
    /// Run the device that a file describes, or a built-in one, as a live node
    Run(RunArguments),
    /// Start a bus that devices and tools attach to over TCP
    Bus(BusArguments),
    /// Print what goes over a bus, decoded
    ///
    /// Time stamps are UTC. Without an EDS, services are told apart by the pre-defined connection set of CiA 301; with one,
    /// objects have their names, values their types, and PDOs the identifiers and mappings of the file.
    Monitor(MonitorArguments),
    /// Send an NMT command: start, stop or reset nodes
    Nmt(NmtArguments),
    /// Read or write the object dictionary of a node
    Sdo(SdoArguments),
    /// Say what rules report, why, and what to write instead
    Explain(ExplainArguments),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print the manual page
    Man,
}

#[derive(Args, Debug)]
pub(crate) struct LintArguments {
    /// Files, globs, or folders that are searched for .eds, .dcf and .cpj files; `-` reads standard input
    #[arg(value_name = "PATH", default_value = ".", value_hint = ValueHint::AnyPath)]
    pub(crate) paths: Vec<PathBuf>,
    /// How findings are printed
    #[arg(long, value_enum, default_value_t = LintFormat::Human)]
    pub(crate) format: LintFormat,
    /// Write to this file instead of standard output, which gets the summary
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) output: Option<PathBuf>,
    /// Hold devices to this profile too, besides those of CiA; may be given several times
    #[arg(long = "profile", value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) profiles: Vec<PathBuf>,
    /// Run only these rules: codes, names or prefixes of codes, or ALL
    #[arg(long, value_name = "RULE", value_delimiter = ',', value_parser = NonEmptyStringValueParser::new())]
    pub(crate) select: Vec<String>,
    /// Run these rules too, besides those that are on by default
    #[arg(long, value_name = "RULE", value_delimiter = ',', value_parser = NonEmptyStringValueParser::new())]
    pub(crate) extend_select: Vec<String>,
    /// Do not run these rules
    #[arg(long, value_name = "RULE", value_delimiter = ',', value_parser = NonEmptyStringValueParser::new())]
    pub(crate) ignore: Vec<String>,
    /// Exit with 1 from this severity on; warning where edskit.toml says nothing
    #[arg(long, value_name = "SEVERITY", value_enum)]
    pub(crate) fail_on: Option<FailOn>,
    /// Apply the safe fixes to the files, and report what is left
    #[arg(long)]
    pub(crate) fix: bool,
    /// With --fix or --diff: apply fixes too that are right only if the intent was guessed right
    #[arg(long)]
    pub(crate) unsafe_fixes: bool,
    /// Change no file; print what --fix would change as a patch, and the findings to the error stream
    #[arg(long, conflicts_with = "fix")]
    pub(crate) diff: bool,
    /// Use these settings instead of the edskit.toml that is found upwards from each file
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) config: Option<PathBuf>,
    /// Heed no edskit.toml
    #[arg(long, conflicts_with = "config")]
    pub(crate) isolated: bool,
    /// Show only findings that are not in this baseline
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) baseline: Option<PathBuf>,
    /// Write all findings into the baseline, so that later runs show only new ones; what it knows of other files and
    /// rules stays
    #[arg(long, conflicts_with_all = ["fix", "diff"])]
    pub(crate) update_baseline: bool,
    /// Take files that are gone out of the baseline
    #[arg(long)]
    pub(crate) prune_baseline: bool,
    /// Print how often each rule fires instead of the findings
    #[arg(long)]
    pub(crate) statistics: bool,
    /// Print findings only: no summary, no progress
    #[arg(long, short)]
    pub(crate) quiet: bool,
    /// When to use colour
    #[arg(long, value_enum, default_value_t = Color::Auto)]
    pub(crate) color: Color,
    /// The name that standard input goes by; its ending says which kind of file it is
    #[arg(long, value_name = "NAME", default_value = "stdin.eds")]
    pub(crate) stdin_filename: String,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum LintFormat {
    /// Source excerpts with labels
    Human,
    /// One line for each finding
    Concise,
    /// JSON
    Json,
    /// SARIF 2.1.0, for code scanning
    Sarif,
    /// Annotations of GitHub Actions
    Github,
    /// JUnit XML
    Junit,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum FailOn {
    /// Only errors
    Error,
    /// Warnings and errors
    Warning,
    /// Every finding
    Info,
}

impl FailOn {
    pub(crate) fn severity(self) -> Severity {
        match self {
            Self::Error => Severity::Error,
            Self::Warning => Severity::Warning,
            Self::Info => Severity::Info,
        }
    }
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Color {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

impl Color {
    /// Whether to use colour where results go to a terminal or not.
    pub(crate) fn is_wanted(self, to_terminal: bool) -> bool {
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => {
                let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
                to_terminal && !refused
            }
        }
    }
}

#[derive(Args, Debug)]
pub(crate) struct FmtArguments {
    /// Files, globs, or folders that are searched for .eds, .dcf and .cpj files; `-` formats standard input to standard
    /// output
    #[arg(value_name = "PATH", default_value = ".", value_hint = ValueHint::AnyPath)]
    pub(crate) paths: Vec<PathBuf>,
    /// Change no file; exit with 1 and name the files that are not in canonical form
    #[arg(long)]
    pub(crate) check: bool,
    /// Change no file; print what would change as a patch
    #[arg(long)]
    pub(crate) diff: bool,
}

#[derive(Args, Debug)]
pub(crate) struct ShowArguments {
    /// The file; `-` reads standard input
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = one_file())]
    pub(crate) file: PathBuf,
    /// One object, or one entry, in hexadecimal: `1018` or `1018:1`
    #[arg(value_name = "INDEX[:SUB]", value_parser = parse_place)]
    pub(crate) place: Option<Place>,
    /// Evaluate `$NODEID` with this node-ID, 1..127; a DCF's own is used where none is given
    #[arg(long, value_name = "ID", value_parser = parse_node_id)]
    pub(crate) node_id: Option<NodeId>,
    /// List what is written wrongly and read as it was meant, instead of the device
    #[arg(long, conflicts_with = "place")]
    pub(crate) meant: bool,
    /// How it is printed
    #[arg(long, value_enum, default_value_t = ShowFormat::Human)]
    pub(crate) format: ShowFormat,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ShowFormat {
    /// Text
    Human,
    /// JSON
    Json,
}

/// An object, or one of its entries.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Place {
    pub(crate) index: u16,
    pub(crate) sub_index: Option<u8>,
}

#[derive(Args, Debug)]
pub(crate) struct ConfigArguments {
    #[command(subcommand)]
    pub(crate) command: ConfigCommand,
}

#[derive(Subcommand, Debug)]
pub(crate) enum ConfigCommand {
    /// Check a parameter file, and print the PDOs that follow from it
    ///
    /// The file is TOML. It names the device (`device = "heinzmann-canopen-gateway"`) and gives the parameters of the
    /// gateway and of the governor behind it; docs/gateway-parameters.md describes it.
    Check(ConfigCheckArguments),
    /// Write the DCF of the device that has these parameters
    ///
    /// It is the data sheet of the gateway with what the parameters make of it: node-ID, bit rate, the entries that exist,
    /// and what they hold after a start. What there is to say on the parameters is printed to the error stream.
    Dcf(ConfigDcfArguments),
    /// Make a parameter file of a table, as the PC tool exports it
    ///
    /// A row has number, name, value and unit, divided by `;`, tabs or blanks; numbers may have a decimal comma, and columns
    /// and rows any order. Rows of what is no parameter of the gateway, or nothing here follows from, are kept as comments.
    Import(ConfigImportArguments),
    /// Write the parameters of a file as a table
    Export(ConfigExportArguments),
}

#[derive(Args, Debug)]
pub(crate) struct ConfigImportArguments {
    /// The tables, for instance one of the gateway and one of the governor; `-` reads standard input
    #[arg(value_name = "FILE", required = true, value_hint = ValueHint::FilePath)]
    pub(crate) files: Vec<PathBuf>,
    /// Where the parameter file goes; standard output if not given
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) output: Option<PathBuf>,
    /// Whose parameters these are, where the table does not say so and their names do not
    #[arg(long, value_enum)]
    pub(crate) unit: Option<ConfigUnit>,
}

#[derive(Args, Debug)]
pub(crate) struct ConfigExportArguments {
    /// The parameter file; `-` reads standard input
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) file: PathBuf,
    /// Where the table goes; standard output if not given
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) output: Option<PathBuf>,
    /// The parameters of one unit alone, without a title
    #[arg(long, value_enum)]
    pub(crate) unit: Option<ConfigUnit>,
}

/// One of the two control units.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ConfigUnit {
    /// The CANopen gateway
    Gateway,
    /// The digital governor
    Governor,
}

#[derive(Args, Debug)]
pub(crate) struct ConfigCheckArguments {
    /// The file; `-` reads standard input
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = one_file())]
    pub(crate) file: PathBuf,
    /// How it is printed
    #[arg(long, value_enum, default_value_t = ConfigFormat::Human)]
    pub(crate) format: ConfigFormat,
    /// Exit with 1 from this severity on
    #[arg(long, value_name = "SEVERITY", value_enum, default_value_t = FailOn::Warning)]
    pub(crate) fail_on: FailOn,
    /// Print findings only: no PDOs, no summary
    #[arg(long, short)]
    pub(crate) quiet: bool,
    /// When to use colour
    #[arg(long, value_enum, default_value_t = Color::Auto)]
    pub(crate) color: Color,
}

#[derive(Args, Debug)]
pub(crate) struct ConfigDcfArguments {
    /// The file with the parameters; `-` reads standard input
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = one_file())]
    pub(crate) file: PathBuf,
    /// Where the DCF goes; standard output if not given
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) output: Option<PathBuf>,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ConfigFormat {
    /// Source excerpts with labels, then a table of the PDOs
    Human,
    /// JSON
    Json,
}

#[derive(Args, Debug)]
pub(crate) struct GenerateArguments {
    /// An EDS or DCF
    #[arg(value_hint = ValueHint::FilePath, value_parser = one_file())]
    pub(crate) file: PathBuf,
    /// The folder that the code is written to; it is made where there is none
    #[arg(long, short, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) output: PathBuf,
    /// What the code is called, the file without .rs and the module in lower case; the EDS's own name if not given
    #[arg(long, value_parser = parse_file_stem)]
    pub(crate) name: Option<String>,
    /// The side-file, instead of the one beside the EDS
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) side_file: Option<PathBuf>,
    /// The path of the crate edskit-runtime in the generated code
    #[arg(long, value_name = "PATH", default_value = "::edskit_runtime")]
    pub(crate) runtime: String,
}

#[derive(ValueEnum, Clone, Copy, Default, PartialEq, Eq, Debug)]
pub(crate) enum LogFormat {
    /// Lines of text
    #[default]
    Text,
    /// A JSON object for each line
    Json,
}

#[derive(Args, Debug)]
pub(crate) struct ExplainArguments {
    /// Codes (SYN013, GWC011), names (duplicate-section) or prefixes of codes (SYN)
    #[arg(value_name = "RULE", required_unless_present = "all", conflicts_with = "all")]
    pub(crate) rules: Vec<String>,
    /// Every rule
    #[arg(long)]
    pub(crate) all: bool,
    /// How it is printed
    #[arg(long, value_enum, default_value_t = ExplainFormat::Human)]
    pub(crate) format: ExplainFormat,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ExplainFormat {
    /// Text
    Human,
    /// A Markdown page with a table of the rules
    Markdown,
    /// A Markdown page with what other tools find, and the rules that find it
    CrossReference,
    /// JSON
    Json,
}

/// Reads the path of one file, which may be a glob.
fn one_file() -> impl TypedValueParser<Value = PathBuf> {
    OsStringValueParser::new().try_map(files::one)
}

fn parse_node_id(text: &str) -> Result<NodeId, String> {
    let number = edskit_model::Number::parse(text.as_bytes()).map_err(|error| error.to_string())?;
    let node_id = number.to::<u8>().and_then(|value| NodeId::new(value).ok());
    node_id.ok_or_else(|| "a node-ID is 1..127".to_owned())
}

fn parse_file_stem(text: &str) -> Result<String, String> {
    let is_name = !text.is_empty() && !text.contains(['/', '\\']);
    if is_name { Ok(text.to_owned()) } else { Err("a name without a folder is expected".to_owned()) }
}

pub(crate) fn parse_place(text: &str) -> Result<Place, String> {
    let hex =
        |digits: &str| digits.strip_prefix("0x").or(digits.strip_prefix("0X")).unwrap_or(digits).to_owned();
    let (index, sub_index) = match text.split_once([':', '.']) {
        Some((index, sub_index)) => (index, Some(sub_index)),
        None => (text, None),
    };
    let index = u16::from_str_radix(&hex(index.trim_end_matches(['h', 'H'])), 16)
        .map_err(|_| format!("`{index}` is not an index of up to four hexadecimal digits"))?;
    let sub_index = sub_index.map(|digits| {
        u8::from_str_radix(&hex(digits.trim_end_matches(['h', 'H'])), 16)
            .map_err(|_| format!("`{digits}` is not a sub-index of up to two hexadecimal digits"))
    });
    Ok(Place { index, sub_index: sub_index.transpose()? })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_grammar_is_sound() {
        Cli::command().debug_assert();
    }

    #[test]
    fn places_are_hexadecimal() {
        assert_eq!(parse_place("1018"), Ok(Place { index: 0x1018, sub_index: None }));
        assert_eq!(parse_place("0x1A00:0A"), Ok(Place { index: 0x1A00, sub_index: Some(10) }));
        assert_eq!(parse_place("1018h:01h"), Ok(Place { index: 0x1018, sub_index: Some(1) }));
        assert!(
            parse_place("10180").is_err() && parse_place("1018:100").is_err() && parse_place("x").is_err()
        );
    }

    #[test]
    fn node_ids_are_1_to_127() {
        assert_eq!(parse_node_id("0x7F").map(NodeId::get), Ok(127));
        assert!(parse_node_id("0").is_err() && parse_node_id("128").is_err() && parse_node_id("a").is_err());
    }
}
