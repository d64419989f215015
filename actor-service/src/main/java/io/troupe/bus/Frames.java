package io.troupe.bus;

import io.troupe.actor.Clock;
import io.troupe.bus.BusMessage.Failure;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.Operation.Kind;
import io.troupe.bus.internal.CborReader;
import io.troupe.bus.internal.CborWriter;
import io.troupe.bus.internal.RecordCodec;
import io.troupe.bus.internal.UnreadableException;
import java.lang.reflect.Type;
import java.util.OptionalLong;
import java.util.function.Function;

/**
 * The frames of one node: messages as bytes, in the format of {@code docs/wire-format.md}.
 *
 * <p>A frame is a CBOR array: version, kind, node and port of the sender, incarnation of the sender's node, number of
 * the message, microseconds from the start of that incarnation until the message was sent; then the fields of the kind;
 * then the payload. A reader ignores elements after the ones that it knows.
 *
 * <p><b>Threads.</b> Any thread.
 */
final class Frames {
    private static final int VERSION = 1;
    private static final int COMMON_FIELDS = 7;
    private static final int PUBLICATION_FIELDS = 3;
    private static final int REQUEST_FIELDS = 5;
    private static final int EXPECTED_SIZE = 256;

    private static final int PUBLICATION = 0;
    private static final int REQUEST = 1;
    private static final int NOTICE = 2;
    private static final int REPLY = 3;
    private static final int REJECTION = 4;
    private static final int CANCELLATION = 5;
    private static final int MARK = 6;

    private final RecordCodec codec;
    private final Clock clock;
    private final long incarnation;
    private final long originNanos;

    Frames(RecordCodec codec, Clock clock, long incarnation) {
        this.codec = codec;
        this.clock = clock;
        this.incarnation = incarnation;
        this.originNanos = clock.nanos();
    }

    // ---- writing

    /**
     * @param series the number of the value among those of its port on its topic
     * @param ageMicros how old it is already, because it is forwarded
     */
    byte[] publication(BusMessage message, String topic, long series, long ageMicros) {
        int fields = ageMicros == 0 ? PUBLICATION_FIELDS : PUBLICATION_FIELDS + 1;
        var out = begin(PUBLICATION, message.from(), message.sequence(), fields);
        out.writeText(topic);
        out.writeLong(series);
        codec.write(message.payload().getClass(), message.payload(), out);
        if (ageMicros != 0) {
            out.writeLong(ageMicros);
        }
        return out.toBytes();
    }

    /**
     * Reports how many values a port has published on a topic, so that a loss of the last ones is noticed, and of the
     * first ones.
     *
     * @param begunNanos when the first one was published
     */
    byte[] mark(Address from, String topic, long series, long begunNanos) {
        var out = begin(MARK, from, 0, 3);
        out.writeText(topic);
        out.writeLong(series);
        out.writeLong(micros(begunNanos));
        return out.toBytes();
    }

    /** @param isShared true if the requests that the handler sends share the limit */
    byte[] request(BusMessage message, Purpose.Request request, long limitMicros, boolean isShared) {
        var out = begin(REQUEST, message.from(), message.sequence(), isShared ? REQUEST_FIELDS + 1 : REQUEST_FIELDS);
        out.writeText(request.to().name());
        out.writeText(request.operation());
        out.writeLong(message.kind().ordinal());
        out.writeLong(limitMicros);
        codec.write(message.payload().getClass(), message.payload(), out);
        if (isShared) {
            out.writeBoolean(true);
        }
        return out.toBytes();
    }

    byte[] notice(BusMessage message, Purpose.Notice notice) {
        var out = begin(NOTICE, message.from(), message.sequence(), 4);
        out.writeText(notice.to().name());
        out.writeText(notice.operation());
        out.writeLong(message.kind().ordinal());
        return complete(out, message.payload());
    }

    byte[] cancellation(BusMessage request, Purpose.Request purpose) {
        var out = begin(CANCELLATION, request.from(), request.sequence(), 2);
        out.writeText(purpose.to().name());
        out.writeText(purpose.operation());
        return out.toBytes();
    }

    /** @param toIncarnation the life of the requester's node */
    byte[] reply(BusMessage message, Purpose.Reply reply, long toIncarnation) {
        var out = beginReply(REPLY, message, reply.to(), toIncarnation, reply.request(), reply.operation());
        return complete(out, message.payload());
    }

    byte[] rejection(BusMessage message, Purpose.Rejection rejection, long toIncarnation) {
        var out = beginReply(
                REJECTION, message, rejection.to(), toIncarnation, rejection.request(), rejection.operation());
        codec.write(Failure.class, message.payload(), out);
        return out.toBytes();
    }

    private CborWriter beginReply(
            int kind, BusMessage message, Address to, long toIncarnation, long request, String operation) {
        var out = begin(kind, message.from(), message.sequence(), 6);
        out.writeText(to.name());
        out.writeLong(toIncarnation);
        out.writeLong(request);
        out.writeText(operation);
        out.writeLong(message.kind().ordinal());
        return out;
    }

    private CborWriter begin(int kind, Address from, long number, int fields) {
        var out = new CborWriter(EXPECTED_SIZE);
        out.writeArray(COMMON_FIELDS + fields);
        out.writeLong(VERSION);
        out.writeLong(kind);
        out.writeText(from.node());
        out.writeText(from.name());
        out.writeLong(incarnation);
        out.writeLong(number);
        out.writeLong(micros(clock.nanos()));
        return out;
    }

    private long micros(long nanos) {
        return Math.max(0, nanos - originNanos) / 1_000;
    }

    private byte[] complete(CborWriter out, Record payload) {
        codec.write(payload.getClass(), payload, out);
        return out.toBytes();
    }

    // ---- reading

    /**
     * A frame whose payload has not been read.
     *
     * @param rest where the payload begins
     */
    record Frame(Header header, Body body, CborReader rest) {
        /** The message, with the payload decoded as that type. */
        BusMessage message(RecordCodec codec, Type type) {
            return message((Record) codec.read(type, rest));
        }

        /** The message with that payload. */
        BusMessage message(Record payload) {
            return BusMessage.of(body.kind(), header.from(), body.purpose(), header.number(), payload);
        }
    }

    /** What every frame has. */
    record Header(Address from, long incarnation, long number, long sentMicros) {}

    /** What depends on the kind of a frame. */
    sealed interface Body {
        Purpose purpose();

        Kind kind();

        /** @param ageMicros how old the value was when it was sent */
        record Published(Purpose.Publication purpose, long series, long ageMicros) implements Body {
            @Override
            public Kind kind() {
                return Kind.DATA;
            }
        }

        /**
         * Comes without a payload.
         *
         * @param begunMicros when the first value was sent, on the clock of the sender's node; empty from small nodes
         */
        record Mark(Purpose.Publication purpose, long series, OptionalLong begunMicros) implements Body {
            @Override
            public Kind kind() {
                return Kind.DATA;
            }
        }

        /** @param isShared true if the requests that the handler sends share the limit */
        record Requested(Purpose.Request purpose, Kind kind, long limitMicros, boolean isShared) implements Body {}

        record Noticed(Purpose.Notice purpose, Kind kind) implements Body {}

        /** Comes without a payload. */
        record Cancelled(Purpose.Request purpose) implements Body {
            @Override
            public Kind kind() {
                return Kind.CONTROL;
            }
        }

        /** @param toIncarnation the life of the node that is to get it */
        record Replied(Purpose.Reply purpose, Kind kind, long toIncarnation) implements Body {}

        record Rejected(Purpose.Rejection purpose, Kind kind, long toIncarnation) implements Body {}
    }

    /**
     * Reads a frame up to its payload.
     *
     * @param node the name of this node
     * @throws UnreadableException if it is no frame of a known version
     */
    static Frame read(byte[] bytes, String node) {
        var in = new CborReader(bytes);
        int elements = in.readArray();
        long version = in.readLong(0, Long.MAX_VALUE);
        if (version != VERSION) {
            throw new UnreadableException("expected a frame of version " + VERSION + ", not " + version).in("frame");
        }
        int kind = (int) in.readLong(0, Integer.MAX_VALUE);
        if (elements < COMMON_FIELDS + 2) {
            throw new UnreadableException("expected more than " + (COMMON_FIELDS + 1) + " elements, not " + elements)
                    .in("frame");
        }
        try {
            var from = new Address(in.readText(), in.readText());
            var header = new Header(from, readNumber(in), readNumber(in), readNumber(in));
            return new Frame(header, readBody(kind, header, node, elements - COMMON_FIELDS, in), in);
        } catch (IllegalArgumentException noAddress) {
            throw new UnreadableException(String.valueOf(noAddress.getMessage())).in("frame");
        }
    }

    private static Body readBody(int kind, Header header, String node, int fields, CborReader in) {
        return switch (kind) {
            case PUBLICATION ->
                new Body.Published(
                        new Purpose.Publication(in.readText()),
                        readNumber(in),
                        fields > PUBLICATION_FIELDS ? readBehindPayload(in.copy()) : 0);
            case MARK ->
                new Body.Mark(
                        new Purpose.Publication(in.readText()),
                        readNumber(in),
                        fields > 2 ? OptionalLong.of(readNumber(in)) : OptionalLong.empty());
            case REQUEST ->
                new Body.Requested(
                        readRequest(node, in),
                        readKind(in),
                        readNumber(in),
                        fields > REQUEST_FIELDS); // the last is true
            case NOTICE ->
                new Body.Noticed(new Purpose.Notice(new Address(node, in.readText()), in.readText()), readKind(in));
            case CANCELLATION -> new Body.Cancelled(readRequest(node, in));
            case REPLY ->
                readReply(
                        node,
                        in,
                        reply -> new Body.Replied(
                                new Purpose.Reply(reply.to, reply.operation, reply.request),
                                reply.kind,
                                reply.toIncarnation));
            case REJECTION ->
                readReply(
                        node,
                        in,
                        reply -> new Body.Rejected(
                                new Purpose.Rejection(reply.to, reply.operation, reply.request),
                                reply.kind,
                                reply.toIncarnation));
            default -> throw new UnreadableException("expected a kind from 0 to " + MARK + ", not " + kind).in("frame");
        };
    }

    private static long readBehindPayload(CborReader in) {
        in.skip();
        return readNumber(in);
    }

    private static Purpose.Request readRequest(String node, CborReader in) {
        return new Purpose.Request(new Address(node, in.readText()), in.readText());
    }

    private record ReplyFields(Address to, long toIncarnation, long request, String operation, Kind kind) {}

    private static Body readReply(String node, CborReader in, Function<ReplyFields, Body> body) {
        var to = new Address(node, in.readText());
        return body.apply(new ReplyFields(to, readNumber(in), readNumber(in), in.readText(), readKind(in)));
    }

    private static long readNumber(CborReader in) {
        return in.readLong(0, Long.MAX_VALUE);
    }

    private static Kind readKind(CborReader in) {
        return Kind.values()[(int) in.readLong(0, 1)];
    }
}
