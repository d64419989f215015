package io.troupe.view.tools;

import io.troupe.sim.Snapshot;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.RunLog;
import io.troupe.view.tools.FoxgloveChannels.Channel;
import io.troupe.view.tools.FoxgloveChannels.Drawn;
import io.troupe.view.tools.RunListener.Level;
import io.troupe.view.tools.RunListener.Reading;
import io.troupe.view.tools.RunListener.Remark;
import io.troupe.view.tools.RunListener.StateBegins;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.locks.LockSupport;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * A viewer that is connected by Foxglove's protocol over a WebSocket: Foxglove, Lichtblick, or a program with one of
 * its client libraries. It gets the channels of an MCAP file of {@link RunExport}, while the run goes on.
 *
 * <p><b>Role.</b> The server of the live page accepts connections, and serves the ones that ask for a WebSocket here.
 *
 * <p><b>Threads.</b> The calling thread reads until the connection ends, a virtual thread writes. Neither holds up the
 * source: the newest reading replaces those that a slow viewer has missed.
 *
 * <p><b>Errors.</b> A request that is no upgrade to this protocol gets an HTTP error. A message that cannot be read
 * gets a status message, and the connection goes on.
 *
 * <p><b>Source.</b> The protocol {@code foxglove.websocket.v1}, and {@code foxglove.sdk.v1} as far as it is the same.
 */
public final class FoxgloveConnection {
    /** What there is to see. Any thread calls it. */
    public interface Source {
        /** The newest reading; null if there is none yet. */
        @Nullable
        Frame newest();

        /** The events from a number on. */
        Events eventsFrom(long number);
    }

    /**
     * A world at a time.
     *
     * @param world another one if another run has begun
     * @param services that control the robots, by robot
     */
    public record Frame(WorldSpec world, Snapshot snapshot, List<String> services) {}

    /**
     * Events, as JSON objects with {@code t}, {@code kind} and what belongs to it.
     *
     * @param next number of the event after them
     */
    public record Events(long next, List<String> json) {}

    private static final List<String> SUBPROTOCOLS = List.of("foxglove.sdk.v1", "foxglove.websocket.v1");
    private static final int MESSAGE_DATA = 1;
    private static final int TIME = 2;
    private static final int ERROR_STATUS = 2;
    private static final int MOST_SUBSCRIPTIONS = 10_000;
    private static final long MOST_ID = 0xFFFFFFFFL;
    private static final long POLL_NANOS = 10_000_000;

    private final WebSocket socket;
    private final Source source;
    private final BooleanSupplier isEnding;

    // ---- guarded by this
    /** By subscription: the channel. */
    private final Map<Long, Channel> subscriptions = new TreeMap<>();

    /** Channels that the client has subscribed to since the writer looked. */
    private final Set<Channel> fresh = new HashSet<>();

    private List<Channel> channels = List.of();

    // ---- of the writer
    private @Nullable WorldSpec world;
    private @Nullable FoxgloveChannels messages;
    private @Nullable Snapshot sent;
    private Drawn drawn = Drawn.AT_START;
    private List<String> drawnServices = List.of();
    private List<Integer> drawnAway = List.of();
    private @Nullable StateBegins state;
    private long nextEvent;
    private volatile boolean ended;

    private FoxgloveConnection(WebSocket socket, Source source, BooleanSupplier isEnding) {
        this.socket = socket;
        this.source = source;
        this.isEnding = isEnding;
    }

    /**
     * Serves a connection until it ends.
     *
     * @param headers of the request for an upgrade, with names in lower case
     * @param isEnding whether the server ends; then this closes the connection
     */
    public static void serve(
            Map<String, String> headers, InputStream in, OutputStream out, Source source, BooleanSupplier isEnding)
            throws IOException, InterruptedException {
        String key = headers.get("sec-websocket-key");
        String subprotocol = subprotocol(headers.getOrDefault("sec-websocket-protocol", ""));
        if (key == null || !"13".equals(headers.get("sec-websocket-version")) || subprotocol == null) {
            String text = "expected a WebSocket of version 13 with the subprotocol " + String.join(" or ", SUBPROTOCOLS)
                    + "\n";
            write(
                    out,
                    "HTTP/1.1 400 Bad Request\r\nSec-WebSocket-Version: 13\r\nContent-Type: text/plain\r\n"
                            + "Connection: close\r\nContent-Length: " + text.length() + "\r\n\r\n" + text);
            return;
        }
        write(
                out,
                "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                        + "Sec-WebSocket-Accept: " + WebSocket.accept(key) + "\r\nSec-WebSocket-Protocol: "
                        + subprotocol + "\r\n\r\n");
        new FoxgloveConnection(new WebSocket(in, out), source, isEnding).run();
    }

    private static void write(OutputStream out, String text) throws IOException {
        out.write(text.getBytes(StandardCharsets.ISO_8859_1));
        out.flush();
    }

    /** The first subprotocol of the client that we know. */
    private static @Nullable String subprotocol(String offered) {
        for (String each : offered.split(",")) {
            if (SUBPROTOCOLS.contains(each.strip())) {
                return each.strip();
            }
        }
        return null;
    }

    private void run() throws IOException, InterruptedException {
        socket.sendText("{\"op\":\"serverInfo\",\"name\":\"" + RunLog.PROGRAM
                + "\",\"capabilities\":[\"time\"],\"supportedEncodings\":[],\"metadata\":{}}");
        Thread writer = Thread.ofVirtual().name("foxglove").start(this::writeAll);
        try {
            for (var message = socket.read(); message != null; message = socket.read()) {
                if (message.text() != null) {
                    accept(message.text());
                }
            }
        } finally {
            ended = true;
            socket.abort(); // the writer may wait for a viewer that reads nothing
            writer.join();
        }
    }

    // ---- from the viewer

    private void accept(String text) throws IOException {
        try {
            JsonObject request = JsonObject.read(text);
            String op = request.text("op");
            switch (op) {
                case "subscribe" -> {
                    for (JsonObject each : request.objects("subscriptions")) {
                        subscribe(each.id("id", MOST_ID), each.id("channelId", MOST_ID));
                    }
                }
                case "unsubscribe" -> {
                    for (long id : request.ids("subscriptionIds", MOST_ID)) {
                        unsubscribe(id);
                    }
                }
                default -> reject("'" + op + "' is not offered by this server");
            }
        } catch (JsonObject.Problem problem) {
            reject(problem.getMessage());
        }
    }

    private void reject(@Nullable String problem) throws IOException {
        byte[] status = new JsonText()
                .begin()
                .put("op", "status")
                .put("level", ERROR_STATUS)
                .put("message", String.valueOf(problem))
                .end();
        socket.sendText(new String(status, StandardCharsets.UTF_8));
    }

    private synchronized void subscribe(long id, long channel) throws JsonObject.Problem {
        if (channel >= channels.size()) {
            throw new JsonObject.Problem(1, "there is no channel " + channel);
        }
        if (subscriptions.containsKey(id)) {
            throw new JsonObject.Problem(1, "subscription " + id + " exists already");
        }
        if (subscriptions.size() >= MOST_SUBSCRIPTIONS) {
            throw new JsonObject.Problem(1, "expected at most " + MOST_SUBSCRIPTIONS + " subscriptions");
        }
        subscriptions.put(id, channels.get((int) channel));
        fresh.add(channels.get((int) channel));
    }

    private synchronized void unsubscribe(long id) throws JsonObject.Problem {
        if (subscriptions.remove(id) == null) {
            throw new JsonObject.Problem(1, "there is no subscription " + id);
        }
    }

    // ---- to the viewer

    private void writeAll() {
        try {
            while (!ended) {
                boolean last = isEnding.getAsBoolean(); // asked before the last news
                writeNews();
                if (last) {
                    socket.close(WebSocket.GOING_AWAY, "the program has ended");
                    return;
                }
                LockSupport.parkNanos(POLL_NANOS);
            }
        } catch (IOException gone) {
            ended = true; // the reading thread finds that out, too
        }
    }

    private void writeNews() throws IOException {
        Frame frame = source.newest();
        if (frame == null) {
            return;
        }
        if (frame.world() != world) {
            begin(frame.world());
        }
        FoxgloveChannels now = messages;
        if (now == null) {
            return;
        }
        Set<Channel> begun = takeFresh();
        long micros = frame.snapshot().timeMicros();
        writeEvents(now);
        boolean isNew = frame.snapshot() != sent;
        if (isNew) {
            ByteBuffer time = ByteBuffer.allocate(1 + Long.BYTES).order(ByteOrder.LITTLE_ENDIAN);
            socket.sendBinary(time.put((byte) TIME).putLong(micros * 1000).array());
        }
        if (!begun.isEmpty()) { // what stays until it changes
            var toNew = new Subscribers(begun);
            now.sendWorld(micros, Drawn.of(frame.snapshot(), frame.world()), toNew);
            now.sendBodies(micros, frame.services(), frame.snapshot().away(), toNew);
            if (state != null) {
                now.send(state, toNew);
            }
        }
        if (isNew) {
            Drawn next = Drawn.of(frame.snapshot(), frame.world());
            now.sendChanges(micros, drawn, next, new Subscribers(null));
            drawn = next;
        }
        if (!frame.services().equals(drawnServices) || !frame.snapshot().away().equals(drawnAway)) {
            drawnServices = frame.services();
            drawnAway = frame.snapshot().away();
            now.sendBodies(micros, drawnServices, drawnAway, new Subscribers(null));
        }
        if (isNew || !begun.isEmpty()) {
            sent = frame.snapshot();
            now.send(new Reading(sent, frame.services(), true), new Subscribers(isNew ? null : begun));
        }
    }

    /** Another world has other channels. */
    private void begin(WorldSpec begun) throws IOException {
        var made = new FoxgloveChannels(begun);
        List<Channel> before;
        synchronized (this) {
            before = channels;
            channels = made.channels();
            subscriptions.clear();
            fresh.clear();
        }
        if (!before.isEmpty()) {
            var ids = new ArrayList<String>();
            before.forEach(channel -> ids.add("" + channel.id()));
            socket.sendText("{\"op\":\"unadvertise\",\"channelIds\":[" + String.join(",", ids) + "]}");
        }
        world = begun;
        messages = made;
        drawnServices = List.of();
        drawnAway = List.of();
        drawn = Drawn.AT_START;
        state = null;
        JsonText text = new JsonText().begin().put("op", "advertise").array("channels");
        for (Channel channel : made.channels()) {
            text.object()
                    .put("id", channel.id())
                    .put("topic", channel.topic())
                    .put("encoding", "json")
                    .put("schemaName", channel.schema().title())
                    .put("schema", channel.schema().text())
                    .put("schemaEncoding", "jsonschema")
                    .endObject();
        }
        socket.sendText(new String(text.endArray().end(), StandardCharsets.UTF_8));
    }

    private synchronized Set<Channel> takeFresh() {
        Set<Channel> taken = Set.copyOf(fresh);
        fresh.clear();
        return taken;
    }

    private void writeEvents(FoxgloveChannels now) throws IOException {
        Events events = source.eventsFrom(nextEvent);
        nextEvent = events.next();
        for (String json : events.json()) {
            try {
                write(JsonObject.read(json), now);
            } catch (JsonObject.Problem problem) {
                throw new IllegalStateException("an event of the live view: " + problem.getMessage() + " in " + json);
            }
        }
    }

    private void write(JsonObject event, FoxgloveChannels now) throws IOException, JsonObject.Problem {
        long micros = StrictMath.round(event.number("t") * 1e6);
        String kind = event.text("kind");
        int robot = event.has("robot") ? event.whole("robot", 1, Integer.MAX_VALUE) : 0;
        if (kind.equals("boxes")) {
            return; // they are in the snapshot
        }
        var to = new Subscribers(null);
        if (kind.equals("state")) {
            state = new StateBegins(
                    micros,
                    event.whole("state", 1, Integer.MAX_VALUE),
                    robot,
                    event.whole("colour", 0, 0xFFFFFF),
                    event.textList("services"));
            now.send(state, to);
        }
        now.send(new Remark(micros, level(kind), robot == 0 ? "run" : "robot " + robot, words(kind, event)), to);
    }

    private static Level level(String kind) {
        return switch (kind) {
            case "contact", "stall", "intervention", "refused" -> Level.WARNING;
            default -> Level.INFO;
        };
    }

    private static String words(String kind, JsonObject event) throws JsonObject.Problem {
        return switch (kind) {
            case "state" -> "state " + event.whole("state", 1, Integer.MAX_VALUE) + " begins";
            case "contact" ->
                "touches "
                        + (event.has("obstacle")
                                ? event.text("obstacle")
                                : "robot " + event.whole("otherRobot", 1, Integer.MAX_VALUE));
            case "stall" -> "stalls";
            case "driver" -> event.has("node") ? "is driven by " + event.text("node") : "has no driver";
            default -> kind + (event.has("text") ? ": " + event.text("text") : "");
        };
    }

    /** Sends messages to those that have subscribed, if their channel is one of the given ones; null = all. */
    private final class Subscribers implements FoxgloveChannels.Sink {
        private final @Nullable Set<Channel> only;

        Subscribers(@Nullable Set<Channel> only) {
            this.only = only;
        }

        @Override
        public boolean isWanted(Channel channel) {
            if (only != null && !only.contains(channel)) {
                return false;
            }
            synchronized (FoxgloveConnection.this) {
                return subscriptions.containsValue(channel);
            }
        }

        @Override
        public void message(Channel channel, long timeNanos, byte[] json) throws IOException {
            List<Long> ids = new ArrayList<>();
            synchronized (FoxgloveConnection.this) {
                subscriptions.forEach((id, each) -> {
                    if (each.equals(channel) && (only == null || only.contains(channel))) {
                        ids.add(id);
                    }
                });
            }
            for (long id : ids) {
                ByteBuffer data = ByteBuffer.allocate(1 + Integer.BYTES + Long.BYTES + json.length)
                        .order(ByteOrder.LITTLE_ENDIAN);
                data.put((byte) MESSAGE_DATA)
                        .putInt((int) id)
                        .putLong(timeNanos)
                        .put(json);
                socket.sendBinary(data.array());
            }
        }
    }
}
