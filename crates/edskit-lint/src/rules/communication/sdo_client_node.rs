use crate::evaluate::{Effective, node_ids};
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::Object;
use edskit_types::{CobId, Index, NodeId};

rule! {
    /// An SDO client is set up by half
    ///
    /// ## What it does
    /// Reports an SDO client parameter (1280h to 12FFh) whose two COB-IDs are valid, but whose sub-index 03h is no node-ID of 1
    /// to 127, and one of whose COB-IDs only one is valid.
    ///
    /// ## Why is this bad
    /// A client needs both directions, and knows by sub-index 03h which device it talks to. Set up by half it does nothing, or
    /// reports errors of a node that does not exist.
    ///
    /// ## Example
    /// ```eds
    /// [1280]
    /// ParameterName=SDO client parameter
    /// ObjectType=0x9
    /// SubNumber=4
    ///
    /// [1280sub1]
    /// ParameterName=COB-ID client to server
    /// DataType=0x0007
    /// DefaultValue=0x605
    ///
    /// [1280sub2]
    /// ParameterName=COB-ID server to client
    /// DataType=0x0007
    /// DefaultValue=0x585
    ///
    /// [1280sub3]
    /// ParameterName=Node-ID of the server
    /// DataType=0x0005
    /// DefaultValue=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1280]
    /// ParameterName=SDO client parameter
    /// ObjectType=0x9
    /// SubNumber=4
    ///
    /// [1280sub1]
    /// ParameterName=COB-ID client to server
    /// DataType=0x0007
    /// DefaultValue=0x605
    ///
    /// [1280sub2]
    /// ParameterName=COB-ID server to client
    /// DataType=0x0007
    /// DefaultValue=0x585
    ///
    /// [1280sub3]
    /// ParameterName=Node-ID of the server
    /// DataType=0x0005
    /// DefaultValue=5
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.34.
    pub(crate) static SDO_CLIENT_NODE = {
        code: "COM016",
        name: "sdo-client-node",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Object(check),
    }
}

fn check(context: &Context<'_>, object: Object<'_>, report: &mut Report) {
    if !(Index::SDO_CLIENT.0..=0x12FF).contains(&object.index().0) {
        return;
    }
    let (Some(request), Some(response)) = (Effective::of(object, 1), Effective::of(object, 2)) else {
        return;
    };
    let Some(own) = node_ids(context).next() else { return };
    let is_valid = |value: Effective<'_>| value.cob_id_at(own).map(CobId::is_valid);
    let (one, other) = match (is_valid(request), is_valid(response)) {
        (Some(true), Some(true)) => return check_node(object, [request, response], report),
        (Some(true), Some(false)) => (response, request),
        (Some(false), Some(true)) => (request, response),
        _ => return,
    };
    report
        .add(one.span(), format!("of the two COB-IDs of the SDO client {} only one is valid", object.index()))
        .here("bit 31 is 1: not valid")
        .label(other.span(), "bit 31 is 0: valid")
        .help("set bit 31 of both for a client that is not used, of none for one that is");
}

/// The server of a client that is in use, as its COB-IDs say.
fn check_node(object: Object<'_>, cob_ids: [Effective<'_>; 2], report: &mut Report) {
    let Some(server) = Effective::of(object, 3) else { return };
    let Some(number) = server.constant::<u64>() else { return };
    if u8::try_from(number).is_ok_and(|number| NodeId::new(number).is_ok()) {
        return;
    }
    let index = object.index();
    let finding = report.add(
        server.span(),
        format!(
            "the server of the SDO client {index} is {number}, but its COB-IDs say that the client is in use"
        ),
    );
    finding.here("not a node-ID").label(cob_ids[0].span(), "bit 31 is 0: valid").help(
        "write the node-ID of the server, or `0x80000000` in both COB-IDs for a client that is not used",
    );
    // Nothing but zeros: nobody has set up this client.
    if number == 0 && cob_ids.iter().all(|cob_id| cob_id.constant() == Some(0)) {
        let mut spans = cob_ids.map(Effective::span);
        spans.sort_unstable();
        let edits = spans.map(|span| Edit::replace(span, "0x80000000")).into();
        finding.unsafe_fix("Make both COB-IDs not valid", edits);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(request: &str, response: &str, server: &str) -> String {
        let mut text = "[1280]\nObjectType=9\n".to_owned();
        for (position, value) in [request, response, server].iter().enumerate() {
            let data_type = if position == 2 { 5 } else { 7 };
            let sub = position + 1;
            text.push_str(&format!("[1280sub{sub}]\nDataType={data_type}\nDefaultValue={value}\n"));
        }
        text
    }

    #[test]
    fn a_client_of_zeros_is_switched_off() {
        assert_eq!(fixed(&SDO_CLIENT_NODE, &text("0", "0x0", "0")), text("0x80000000", "0x80000000", "0"));
        assert_eq!(fixed(&SDO_CLIENT_NODE, &text("0x605", "0x585", "0")), text("0x605", "0x585", "0"));
    }

    #[test]
    fn all_three_must_agree() {
        let found = |request: &str, response: &str, server: &str| {
            findings(&SDO_CLIENT_NODE, &text(request, response, server))
        };
        assert!(found("0x80000000", "0x80000000", "0").is_empty());
        assert!(found("0x605", "0x585", "5").is_empty());
        assert!(found("$NODEID+0x600", "$NODEID+0x580", "").is_empty());
        assert_eq!(
            found("0x605", "0x585", "0x80"),
            [
                "11:14 warning: the server of the SDO client 1280h is 128, but its COB-IDs say that the client is in use"
            ]
        );
        assert_eq!(
            found("0x605", "0x80000000", "5"),
            ["8:14 warning: of the two COB-IDs of the SDO client 1280h only one is valid"]
        );
    }
}
