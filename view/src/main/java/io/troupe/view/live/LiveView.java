package io.troupe.view.live;

import com.sun.net.httpserver.Headers;
import com.sun.net.httpserver.HttpExchange;
import com.sun.net.httpserver.HttpServer;
import io.troupe.actor.CallGraph;
import io.troupe.actor.Clock;
import io.troupe.view.Json;
import io.troupe.view.tools.FoxgloveConnection;
import io.troupe.view.tools.FoxgloveConnection.Events;
import io.troupe.view.tools.FoxgloveConnection.Frame;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.lang.System.Logger.Level;
import java.net.BindException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.security.SecureRandom;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * A server with one page, on which browsers see a world while it runs, and from which they control it.
 *
 * {@snippet :
 * try (var page = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
 *     address = page.address();
 *     var viewed = new ViewedRun(scenario.world(), SubsumptionTable.ofThePaper(), control).onto(page);
 *     result = run.run(log, viewed.listener(RecordedRun.Listener.NONE));
 * }
 * }
 *
 * <p><b>Threads.</b> Each viewer has a virtual thread, which is woken by a new frame, sends at most
 * {@value #MOST_FRAMES_PER_S} frames a second and skips those in between. The thread that shows frames never waits for
 * a viewer.
 *
 * <p><b>Errors.</b> A port that is taken is a {@link BindException}. A request from another site, under another name,
 * without the token, or for anything but the page and its data is refused.
 */
public final class LiveView implements AutoCloseable {
    /** Where the page is unless another port is given. */
    public static final int PORT = 8090;

    static final int MOST_FRAMES_PER_S = 30;
    static final int MOST_VIEWERS = 64;
    static final int MOST_COMMAND_BYTES = 4_096;
    static final int MOST_CHOSEN = 16;
    private static final int MOST_ROBOTS = 0xFFFF; // that a page can choose among
    private static final String NO_DELAY = "sun.net.httpserver.nodelay";

    private static final System.Logger LOG = System.getLogger(LiveView.class.getName());
    private static final String FOXGLOVE = "https://app.foxglove.dev";
    private static final String UTF_8_TEXT = "text/plain; charset=utf-8";
    private static final long FRAME_NANOS = 1_000_000_000 / MOST_FRAMES_PER_S;
    /** How long a change without a frame may wait, for example a new speed. */
    private static final long POLL_NANOS = 50_000_000;

    private static final long ALIVE_NANOS = 1_000_000_000;
    private static final Duration CLOSING = Duration.ofSeconds(1);

    /**
     * Where to listen.
     *
     * @param address the loopback address, or one that other hosts reach; then the address of the page has a token
     * @param port 0 = any that is free
     */
    public record Settings(InetAddress address, int port) {
        /** The loopback address and the usual port. */
        public static Settings defaults() {
            return new Settings(InetAddress.getLoopbackAddress(), PORT);
        }

        public Settings withPort(int newPort) {
            return new Settings(address, newPort);
        }

        public Settings withAddress(InetAddress newAddress) {
            return new Settings(newAddress, port);
        }
    }

    private final HttpServer server;
    private final SharedPort port;
    private final InetAddress bound;
    private final @Nullable String token;
    private final ViewPage page = ViewPage.live();
    private final ViewBoard board = new ViewBoard();
    private final Map<String, Viewer> viewers = new ConcurrentHashMap<>();
    private final AtomicInteger sockets = new AtomicInteger();
    private final FoxgloveSource foxglove = new FoxgloveSource(board);
    private final ViewedCalls calls = new ViewedCalls();
    private final SecureRandom random = new SecureRandom();
    private volatile ViewControl control = ViewControl.NONE;
    private volatile @Nullable String ending;

    private LiveView(HttpServer server, SharedPort port, InetAddress bound) {
        this.server = server;
        this.port = port;
        this.bound = bound;
        this.token = bound.isLoopbackAddress() ? null : word();
    }

    /**
     * Creates the server behind the port of the page. Without the setting a small frame would wait for the previous
     * one. The JDK reads it once, with the first server of the JVM, and has no other way; the property is not left
     * behind.
     */
    private static synchronized HttpServer localServer() throws IOException {
        var address = new InetSocketAddress(InetAddress.getLoopbackAddress(), 0);
        if (System.getProperty(NO_DELAY) != null) {
            return HttpServer.create(address, 0);
        }
        System.setProperty(NO_DELAY, "true");
        try {
            return HttpServer.create(address, 0);
        } finally {
            System.clearProperty(NO_DELAY);
        }
    }

    /** Begins to listen. */
    public static LiveView open(Settings settings) throws IOException {
        HttpServer server = localServer();
        SharedPort port;
        try {
            port = SharedPort.bind(settings.address(), settings.port(), server.getAddress());
        } catch (BindException e) {
            server.stop(0);
            var named = new BindException("the live page cannot listen on "
                    + settings.address().getHostAddress() + ":" + settings.port() + " (" + e.getMessage()
                    + "), expected a free port of this machine");
            named.initCause(e);
            throw named;
        }
        var view = new LiveView(server, port, settings.address());
        server.setExecutor(Executors.newVirtualThreadPerTaskExecutor());
        server.createContext("/", view::handle);
        server.start();
        port.start(view::connect);
        return view;
    }

    private String word() {
        byte[] bytes = new byte[16];
        random.nextBytes(bytes);
        return HexFormat.of().formatHex(bytes);
    }

    /** The address of the page. */
    public String address() {
        String host = bound.isAnyLocalAddress() || bound.isLoopbackAddress() ? "localhost" : literal(bound);
        return "http://" + host + ":" + port() + "/" + (token == null ? "" : "?t=" + token);
    }

    public int port() {
        return port.port();
    }

    /** The number of connected viewers. */
    public int viewers() {
        return viewers.size() + sockets.get();
    }

    /** Counts calls for the page: it shows the actors of the spaces that have this in their settings. */
    public CallGraph callGraph() {
        return calls.graph();
    }

    /** What the page shows from now on. */
    ViewSink show(ViewControl newControl) {
        control = newControl;
        return board;
    }

    // ---- requests

    private void handle(HttpExchange exchange) {
        try (exchange) {
            String refusal = refusal(exchange);
            if (refusal != null) {
                answer(exchange, 403, UTF_8_TEXT, refusal);
                return;
            }
            String path = exchange.getRequestURI().getPath();
            String request = exchange.getRequestMethod() + " " + path;
            switch (request) {
                case "GET /" -> answer(exchange, 200, "text/html; charset=utf-8", page.html());
                case "GET /stream" -> stream(exchange);
                case "POST /command" -> command(exchange);
                case "POST /select" -> select(exchange);
                default -> answer(exchange, 404, UTF_8_TEXT, "there is nothing here but the page at /\n");
            }
        } catch (IOException gone) {
            LOG.log(Level.DEBUG, "a viewer left", gone);
        } catch (RuntimeException e) {
            LOG.log(Level.WARNING, "a request to the live page failed", e);
        }
    }

    private void answer(HttpExchange exchange, int status, String type, String text) throws IOException {
        byte[] content = text.getBytes(StandardCharsets.UTF_8);
        head(exchange, type);
        exchange.sendResponseHeaders(status, content.length == 0 ? -1 : content.length);
        if (content.length > 0) {
            exchange.getResponseBody().write(content);
        }
    }

    private void head(HttpExchange exchange, String type) {
        Headers head = exchange.getResponseHeaders();
        head.set("Content-Type", type);
        head.set("Cache-Control", "no-store");
        head.set("Content-Security-Policy", page.policy());
        head.set("X-Content-Type-Options", "nosniff");
        head.set("X-Frame-Options", "DENY");
        head.set("Referrer-Policy", "no-referrer");
        head.set("Cross-Origin-Resource-Policy", "same-origin");
    }

    /** Reason why a request is not answered, or null. */
    private @Nullable String refusal(HttpExchange exchange) {
        Headers headers = exchange.getRequestHeaders();
        String host = headers.getFirst("Host");
        String refusal = refusal(host, exchange.getRequestURI().getRawQuery());
        if (refusal != null) {
            return refusal;
        }
        String origin = headers.getFirst("Origin");
        boolean changes = !exchange.getRequestMethod().equals("GET");
        if (origin == null ? changes : !origin.equals("http://" + host)) {
            return "the request is of " + (origin == null ? "no page" : origin) + ", expected http://" + host + "\n";
        }
        return null;
    }

    private @Nullable String refusal(@Nullable String host, @Nullable String query) {
        if (host == null || token == null && !names().contains(host)) {
            return "the name " + host + " is not one of this page, expected " + String.join(" or ", names()) + "\n";
        }
        String given = parameters(query).getOrDefault("t", "");
        if (token != null
                && !MessageDigest.isEqual(
                        token.getBytes(StandardCharsets.UTF_8), given.getBytes(StandardCharsets.UTF_8))) {
            return "the token is missing or wrong, expected the whole address that the program printed\n";
        }
        return null;
    }

    /** The names under which a page that is only for this machine may be asked for. */
    private List<String> names() {
        return Stream.of("localhost", "127.0.0.1", "[::1]", literal(bound))
                .distinct()
                .map(each -> each + ":" + port())
                .toList();
    }

    private static String literal(InetAddress address) {
        String text = address.getHostAddress();
        return text.contains(":") ? "[" + text + "]" : text;
    }

    private static Map<String, String> parameters(@Nullable String raw) {
        return raw == null
                ? Map.of()
                : Arrays.stream(raw.split("&"))
                        .map(each -> each.split("=", 2))
                        .filter(each -> each.length == 2)
                        .collect(Collectors.toMap(each -> each[0], each -> each[1], (one, other) -> one));
    }

    private static String body(HttpExchange exchange) throws IOException {
        byte[] bytes = exchange.getRequestBody().readNBytes(MOST_COMMAND_BYTES + 1);
        if (bytes.length > MOST_COMMAND_BYTES) {
            throw new IllegalArgumentException("the request is longer than " + MOST_COMMAND_BYTES + " bytes");
        }
        return new String(bytes, StandardCharsets.UTF_8);
    }

    private void command(HttpExchange exchange) throws IOException {
        ViewedWorld world = board.world();
        try {
            if (world == null) {
                throw new IllegalArgumentException("there is no world yet");
            }
            int robots = world.spec().robots().size();
            List<ViewCommand> commands = body(exchange)
                    .lines()
                    .map(line -> ViewCommand.parse(line, robots))
                    .toList();
            commands.forEach(control::submit);
            board.wakeAll();
        } catch (IllegalArgumentException e) {
            answer(exchange, 400, UTF_8_TEXT, e.getMessage() + "\n");
            return;
        }
        answer(exchange, 204, UTF_8_TEXT, "");
    }

    /** The viewer, then the numbers of the robots whose readings it gets. */
    private void select(HttpExchange exchange) throws IOException {
        try {
            String[] words = body(exchange).strip().split(" +");
            Viewer viewer = viewers.get(words[0]);
            if (viewer == null) {
                throw new IllegalArgumentException(
                        "there is no such viewer, expected the word that the stream began with");
            }
            viewer.chosen = Arrays.stream(words)
                    .skip(1)
                    .limit(MOST_CHOSEN)
                    .map(word -> ViewCommand.robot(word, MOST_ROBOTS))
                    .toList();
            board.wakeAll();
        } catch (IllegalArgumentException e) {
            answer(exchange, 400, UTF_8_TEXT, e.getMessage() + "\n");
            return;
        }
        answer(exchange, 204, UTF_8_TEXT, "");
    }

    private void stream(HttpExchange exchange) throws IOException {
        var viewer = new Viewer();
        String name = word();
        viewers.put(name, viewer);
        try {
            if (viewers.size() > MOST_VIEWERS) {
                answer(exchange, 503, UTF_8_TEXT, MOST_VIEWERS + " viewers are connected, and that is the most\n");
                return;
            }
            head(exchange, "application/octet-stream");
            exchange.sendResponseHeaders(200, 0);
            try (var out = exchange.getResponseBody()) {
                viewer.serve(name, out);
            }
        } finally {
            viewers.remove(name);
        }
    }

    // ---- WebSockets

    /** Serves a connection that asks for a WebSocket. */
    private void connect(SharedPort.Head head, InputStream in, OutputStream out)
            throws IOException, InterruptedException {
        String host = head.headers().get("host");
        String[] target = head.target().split("\\?", 2);
        String refusal = refusal(host, target.length > 1 ? target[1] : null);
        String origin = head.headers().get("origin");
        if (refusal == null && token == null && origin != null && !mayConnect(origin)) {
            refusal = "the request is of " + origin + ", expected a program of this machine or " + FOXGLOVE + "\n";
        }
        if (refusal != null) {
            byte[] text = refusal.getBytes(StandardCharsets.UTF_8);
            String lines = "HTTP/1.1 403 Forbidden\r\nContent-Type: " + UTF_8_TEXT + "\r\nContent-Length: "
                    + text.length + "\r\nConnection: close\r\n\r\n";
            out.write(lines.getBytes(StandardCharsets.UTF_8));
            out.write(text);
            out.flush();
            return;
        }
        sockets.incrementAndGet();
        try {
            FoxgloveConnection.serve(head.headers(), in, out, foxglove, () -> ending != null);
        } finally {
            sockets.decrementAndGet();
        }
    }

    /**
     * Whether a page of this origin may connect. Desktop programs have the origin of a file; other pages of this
     * machine are programs that its user has started.
     */
    private static boolean mayConnect(String origin) {
        return origin.equals("file://")
                || origin.equals(FOXGLOVE)
                || origin.matches("https?://(localhost|127\\.0\\.0\\.1|\\[::1\\])(:\\d{1,5})?");
    }

    /** One connected page, on its thread. */
    private final class Viewer {
        volatile List<Integer> chosen = List.of();
        private @Nullable ViewedWorld world;
        private long sentFrame = -1;
        private List<Integer> sentChosen = List.of();
        private long nextEvent;
        private @Nullable String sentTime;
        private @Nullable String sentCalls;
        private boolean wrote;

        void serve(String name, OutputStream out) throws IOException {
            write(
                    out,
                    ViewMessages.text(
                            ViewMessages.HELLO, new Json().put("viewer", name).toString()));
            out.flush();
            var waiting = new ViewBoard.Waiting();
            board.enter(waiting);
            try {
                serve(out, waiting);
            } finally {
                board.leave(waiting);
            }
        }

        private void serve(OutputStream out, ViewBoard.Waiting waiting) throws IOException {
            long sentNanos = Clock.system().nanos();
            while (true) {
                String end = ending; // read before the last frame
                wrote = false;
                writeNews(out);
                long now = Clock.system().nanos();
                if (end != null) {
                    write(
                            out,
                            ViewMessages.text(
                                    ViewMessages.END, new Json().put("why", end).toString()));
                    return;
                }
                if (!wrote && now - sentNanos > ALIVE_NANOS) {
                    write(out, ViewMessages.text(ViewMessages.ALIVE, ""));
                }
                if (wrote) {
                    out.flush();
                    sentNanos = now;
                    LockSupport.parkNanos(FRAME_NANOS);
                } else {
                    waiting.await(POLL_NANOS, this::hasNewFrame);
                }
            }
        }

        private boolean hasNewFrame() {
            ViewBoard.Shown newest = board.newest();
            return ending != null || newest != null && newest.frame.number() != sentFrame;
        }

        private void writeNews(OutputStream out) throws IOException {
            ViewedWorld now = board.world();
            if (now == null) {
                return;
            }
            if (now != world) {
                world = now;
                sentFrame = -1;
                write(out, ViewMessages.text(ViewMessages.WORLD, now.json()));
                for (ViewBoard.Shown shown : board.past()) {
                    write(out, ViewMessages.frame(shown.world, shown.frame, true));
                }
            }
            writeEvents(out);
            String time = new Json()
                    .put("paused", control.isPaused())
                    .put("speed", control.speed())
                    .put("waitsFor", control.waitsFor())
                    .toString();
            if (!time.equals(sentTime)) {
                sentTime = time;
                write(out, ViewMessages.text(ViewMessages.TIME, time));
            }
            String counted = calls.text();
            if (!counted.equals(sentCalls)) {
                sentCalls = counted;
                write(out, ViewMessages.text(ViewMessages.CALLS, counted));
            }
            writeFrame(out, now);
        }

        private void writeEvents(OutputStream out) throws IOException {
            ViewBoard.Events news = board.eventsFrom(nextEvent);
            nextEvent = news.last();
            if (!news.json().isEmpty()) {
                write(out, ViewMessages.text(ViewMessages.EVENTS, "[" + String.join(",", news.json()) + "]"));
            }
        }

        private void writeFrame(OutputStream out, ViewedWorld now) throws IOException {
            ViewBoard.Shown newest = board.newest();
            List<Integer> wanted = chosen;
            if (newest != null
                    && newest.world == now
                    && (newest.frame.number() != sentFrame || !wanted.equals(sentChosen))) {
                sentFrame = newest.frame.number();
                sentChosen = wanted;
                write(out, newest.message());
                if (!wanted.isEmpty()) {
                    write(out, ViewMessages.devices(newest.frame, wanted));
                    write(out, ViewMessages.sensors(newest.frame, wanted));
                }
            }
        }

        private void write(OutputStream out, byte[] message) throws IOException {
            out.write(message);
            wrote = true;
        }
    }

    /** Sends the viewers the last frame and a reason, and stops listening. */
    public void close(String why) {
        ending = why;
        board.wakeAll();
        long deadline = Clock.system().nanos() + CLOSING.toNanos();
        while (viewers() > 0 && Clock.system().nanos() < deadline) {
            LockSupport.parkNanos(TimeUnit.MILLISECONDS.toNanos(5)); // a frozen viewer is left behind
        }
        try {
            port.close();
        } catch (IOException e) {
            LOG.log(Level.WARNING, "the port of the live page could not be closed", e);
        }
        server.stop(0);
    }

    @Override
    public void close() {
        close("the program has ended");
    }

    /** What the live page shows, for viewers that are connected by Foxglove's protocol. */
    private static final class FoxgloveSource implements FoxgloveConnection.Source {
        private final ViewBoard board;
        private volatile @Nullable Converted last;

        private record Converted(ViewBoard.Shown from, Frame frame) {}

        FoxgloveSource(ViewBoard board) {
            this.board = board;
        }

        @Override
        public @Nullable Frame newest() {
            ViewBoard.Shown shown = board.newest();
            if (shown == null) {
                return null;
            }
            Converted known = last;
            if (known == null || known.from != shown) {
                var frame = new Frame(shown.world.spec(), shown.frame.snapshot(), services(shown));
                known = new Converted(shown, frame);
                last = known;
            }
            return known.frame;
        }

        private static List<String> services(ViewBoard.Shown shown) {
            List<String> known = shown.world.services();
            List<String> services = new ArrayList<>();
            for (short state : shown.frame.states()) {
                int number = state & 0xFF;
                int index = number - ViewFrame.FIRST_SERVICE;
                services.add(
                        number == ViewFrame.NO_SERVICE
                                ? "none"
                                : index >= 0 && index < known.size() ? known.get(index) : "several");
            }
            return services;
        }

        @Override
        public Events eventsFrom(long number) {
            ViewBoard.Events events = board.eventsFrom(number);
            return new Events(events.last(), events.json());
        }
    }
}
