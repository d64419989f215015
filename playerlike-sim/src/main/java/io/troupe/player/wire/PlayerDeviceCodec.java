package io.troupe.player.wire;

/** Encodes and decodes requests to the player device, its replies, and SYNCH. */
final class PlayerDeviceCodec {
    static final int SYNCH_OK = 1;
    static final int SYNCH_OVERFLOW = 2;

    private static final int DEVICE_LIST = 1;
    private static final int DRIVER_INFO = 2;
    private static final int ACCESS = 3;
    private static final int NEXT_DATA = 4;
    private static final int DATA_MODE = 5;
    private static final int ADD_RULE = 10;
    private static final int CAPABILITY = 255;
    private static final int PUSH = 1;
    private static final int PULL = 2;

    private PlayerDeviceCodec() {}

    static Content encode(PlayerRequest request) {
        var out = new XdrWriter();
        return switch (request) {
            case PlayerRequest.DeviceList list -> Content.empty(DEVICE_LIST);
            case PlayerRequest.DriverInfo info -> {
                XdrStructures.address(out, info.device());
                yield new Content(DRIVER_INFO, out.opaque(Content.NONE).bytes());
            }
            case PlayerRequest.Access access -> {
                XdrStructures.address(out, access.device());
                yield new Content(
                        ACCESS, out.int32(access.mode()).opaque(Content.NONE).bytes());
            }
            case PlayerRequest.NextData next -> Content.empty(NEXT_DATA);
            case PlayerRequest.DataMode data ->
                new Content(
                        DATA_MODE,
                        out.int32(data.mode() == Delivery.PUSH ? PUSH : PULL).bytes());
            case PlayerRequest.AddRule add -> {
                ReplaceRule rule = add.rule();
                out.int32(rule.interfaceCode()).int32(rule.index());
                out.int32(rule.type()).int32(rule.subtype()).int32(rule.replace());
                yield new Content(ADD_RULE, out.bytes());
            }
            case PlayerRequest.Capability capability ->
                new Content(
                        CAPABILITY,
                        out.int32(capability.type()).int32(capability.subtype()).bytes());
            case PlayerRequest.Other other -> Content.empty(other.subtype());
        };
    }

    static PlayerRequest request(int subtype, byte[] payload) throws WireException {
        var in = new XdrReader("player REQ " + subtype, payload);
        PlayerRequest request = switch (subtype) {
            case DEVICE_LIST -> {
                if (payload.length > 0) { // javaclient sends an empty list
                    in.array("devices", XdrStructures.ADDRESS_BYTES, XdrStructures::address);
                }
                yield new PlayerRequest.DeviceList();
            }
            case DRIVER_INFO -> {
                DeviceAddress device = XdrStructures.address(in);
                in.string("driver name");
                yield new PlayerRequest.DriverInfo(device);
            }
            case ACCESS -> {
                DeviceAddress device = XdrStructures.address(in);
                int mode = in.uint8("access");
                in.string("driver name");
                yield new PlayerRequest.Access(device, mode);
            }
            case NEXT_DATA -> new PlayerRequest.NextData();
            case DATA_MODE -> new PlayerRequest.DataMode(delivery(in.uint8("mode")));
            case ADD_RULE -> new PlayerRequest.AddRule(rule(in));
            case CAPABILITY -> new PlayerRequest.Capability(in.int32("type"), in.int32("subtype"));
            default -> new PlayerRequest.Other(subtype);
        };
        if (!(request instanceof PlayerRequest.Other)) {
            in.end();
        }
        return request;
    }

    private static Delivery delivery(int mode) throws WireException {
        return switch (mode) {
            case PUSH -> Delivery.PUSH;
            case PULL -> Delivery.PULL;
            default -> throw new WireException("player REQ 5: mode is " + mode + ", expected 1 (push) or 2 (pull)");
        };
    }

    private static ReplaceRule rule(XdrReader in) throws WireException {
        int interfaceCode = in.int32("interface");
        int index = in.int32("index");
        int type = in.int32("type");
        int subtype = in.int32("subtype");
        int replace = in.int32("replace");
        if (replace < ReplaceRule.ACCEPT || replace > ReplaceRule.IGNORE) {
            throw new WireException("player REQ 10: replace is " + replace + ", expected 0 to 2");
        }
        return new ReplaceRule(interfaceCode, index, type, subtype, replace);
    }

    /** True if the player device supports such a message. */
    static boolean isServed(int type, int subtype) {
        return type == MessageType.REQ.code()
                && switch (subtype) {
                    case DEVICE_LIST, DRIVER_INFO, ACCESS, NEXT_DATA, DATA_MODE, ADD_RULE, CAPABILITY -> true;
                    default -> false;
                };
    }

    static MessageType type(PlayerReply reply) {
        return reply instanceof PlayerReply.Nack ? MessageType.NACK : MessageType.ACK;
    }

    static byte[] encode(PlayerReply reply) {
        var out = new XdrWriter();
        switch (reply) {
            case PlayerReply.Ack ack -> {}
            case PlayerReply.Nack nack -> {} // javaclient does not skip the payload of a NACK
            case PlayerReply.DeviceList list -> out.array(list.devices(), XdrStructures::address);
            case PlayerReply.DriverInfo info -> {
                XdrStructures.address(out, info.device());
                out.string(info.driver());
            }
            case PlayerReply.Access access -> {
                XdrStructures.address(out, access.device());
                out.int32(access.mode()).string(access.driver());
            }
        }
        return out.bytes();
    }

    /** Decodes the reply to a request of that subtype. Real servers send a NACK with or without a payload. */
    static PlayerReply reply(MessageType type, int subtype, byte[] payload) throws WireException {
        if (type == MessageType.NACK) {
            return new PlayerReply.Nack();
        }
        var in = new XdrReader("player ACK " + subtype, payload);
        PlayerReply reply = switch (subtype) {
            case DEVICE_LIST ->
                new PlayerReply.DeviceList(in.array("devices", XdrStructures.ADDRESS_BYTES, XdrStructures::address));
            case DRIVER_INFO -> new PlayerReply.DriverInfo(XdrStructures.address(in), in.string("driver name"));
            case ACCESS ->
                new PlayerReply.Access(XdrStructures.address(in), in.uint8("access"), in.string("driver name"));
            default -> new PlayerReply.Ack();
        };
        in.end();
        return reply;
    }

    /** The content of a SYNCH, which ends a frame in pull mode. */
    static Content synch(int droppedMessages) {
        return droppedMessages == 0
                ? Content.empty(SYNCH_OK)
                : new Content(
                        SYNCH_OVERFLOW, new XdrWriter().int32(droppedMessages).bytes());
    }

    /** Number of messages that the server has dropped for this client. */
    static int dropped(int subtype, byte[] payload) throws WireException {
        return subtype == SYNCH_OVERFLOW ? new XdrReader("SYNCH 2", payload).int32("dropped messages") : 0;
    }
}
