package io.troupe.bus;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** A simple model of a bus: lists, without threads or promises. */
final class BusModel {
    /** The behaviour of a request handler. */
    enum Manner {
        ANSWERS,
        THROWS,
        KEEPS
    }

    /** A subscription. */
    static final class Reader {
        final List<String> heard = new ArrayList<>();
        final ArrayDeque<String> waiting = new ArrayDeque<>();
    }

    /** A request; the outcome is null while it is pending. */
    static final class Request {
        final int id;
        final String requester;
        final long deadlineSeconds;

        @Nullable
        String outcome;

        Request(int id, String requester, long deadlineSeconds) {
            this.id = id;
            this.requester = requester;
            this.deadlineSeconds = deadlineSeconds;
        }
    }

    /** A port with a request handler. */
    private static final class Handler {
        final Manner manner;
        final ArrayDeque<Request> waiting = new ArrayDeque<>();
        final List<Request> kept = new ArrayList<>();

        Handler(Manner manner) {
            this.manner = manner;
        }
    }

    private final int capacity;
    private final int nodes;
    private final Map<Integer, Reader> readers = new LinkedHashMap<>();
    private final Map<Integer, String> portOf = new LinkedHashMap<>();
    private final Map<String, Handler> handlers = new LinkedHashMap<>();
    private final List<Request> questions = new ArrayList<>();
    private final Map<Integer, Reader> all = new LinkedHashMap<>();
    private final List<Request> keptByNobody = new ArrayList<>();
    long dropped;
    long discarded;
    long queued;
    long late;
    private long seconds;

    /** @param nodes the ports are distributed over this many nodes by their numbers */
    BusModel(int capacity, int nodes) {
        this.nodes = nodes;
        this.capacity = capacity;
    }

    void subscribe(int reader, String port) {
        readers.put(reader, new Reader());
        all.put(reader, readers.get(reader));
        portOf.put(reader, port);
    }

    void publish(String value) {
        for (var reader : readers.values()) {
            if (reader.waiting.size() == capacity) {
                reader.waiting.remove();
                dropped++;
            }
            reader.waiting.add(value);
            queued++;
        }
    }

    void unsubscribe(int reader) {
        var gone = readers.remove(reader);
        if (gone != null) {
            discarded += gone.waiting.size();
        }
    }

    void answer(String port, Manner manner) {
        handlers.put(port, new Handler(manner));
    }

    void ask(int id, String requester, String to, long limitSeconds) {
        var request = new Request(id, requester, seconds + limitSeconds);
        questions.add(request);
        var handler = handlers.get(to);
        if (handler == null) {
            request.outcome = "refused";
        } else if (handler.waiting.size() == capacity) {
            request.outcome = "refused";
        } else {
            handler.waiting.add(request);
        }
    }

    void crank() {
        for (var reader : readers.values()) {
            reader.heard.addAll(reader.waiting);
            reader.waiting.clear();
        }
        for (var entry : handlers.entrySet()) {
            var handler = entry.getValue();
            for (var request = handler.waiting.poll(); request != null; request = handler.waiting.poll()) {
                if (begun(entry.getKey(), handler).size() >= capacity && isKnownToWait(request, entry.getKey())) {
                    var evicted = oldestFromAnotherNode(entry.getKey(), handler);
                    settle(evicted == null ? request : evicted, "refused");
                    if (evicted == null) {
                        continue;
                    }
                    handler.kept.remove(evicted);
                    keptByNobody.add(evicted);
                }
                switch (handler.manner) {
                    case ANSWERS -> settle(request, "answered " + request.id);
                    case THROWS -> settle(request, "failed");
                    case KEEPS -> handler.kept.add(request);
                }
            }
        }
    }

    /**
     * The begun requests of a request handler, as far as the handler's node knows: a cancelled request is removed only
     * if its requester is on the same node.
     */
    private List<Request> begun(String name, Handler handler) {
        return handler.kept.stream()
                .filter(request -> isKnownToWait(request, name))
                .toList();
    }

    private @Nullable Request oldestFromAnotherNode(String name, Handler handler) {
        return handler.kept.stream()
                .filter(request -> nodeOf(request.requester) != nodeOf(name))
                .findFirst()
                .orElse(null);
    }

    private boolean isKnownToWait(Request request, String handler) {
        return request.outcome == null || nodeOf(request.requester) != nodeOf(handler);
    }

    private int nodeOf(String port) {
        return (port.charAt(port.length() - 1) - '0') % nodes;
    }

    private void settle(Request request, String outcome) {
        if (request.outcome == null) {
            request.outcome = outcome;
        } else {
            late++;
        }
    }

    /** Replies to all requests that were kept open. */
    void answerKept() {
        for (var handler : handlers.values()) {
            handler.kept.forEach(request -> settle(request, "answered " + request.id));
            handler.kept.clear();
        }
        late += keptByNobody.size();
        keptByNobody.clear();
    }

    void advance(long by) {
        seconds += by;
        for (var request : questions) {
            if (request.outcome == null && request.deadlineSeconds < seconds) {
                request.outcome = "timed out";
            }
        }
    }

    void close(String port) {
        portOf.forEach((reader, its) -> {
            if (its.equals(port)) {
                unsubscribe(reader);
            }
        });
        var handler = handlers.remove(port);
        if (handler != null) {
            handler.waiting.forEach(request -> settle(request, "refused"));
            begun(port, handler).forEach(request -> settle(request, "refused"));
            keptByNobody.addAll(handler.kept);
        }
        for (var request : questions) {
            if (request.requester.equals(port) && request.outcome == null) {
                request.outcome = "refused";
            }
        }
    }

    Map<Integer, List<String>> heard() {
        var heard = new LinkedHashMap<Integer, List<String>>();
        all.forEach((number, reader) -> heard.put(number, reader.heard));
        return heard;
    }

    Map<Integer, String> answers() {
        var answers = new LinkedHashMap<Integer, String>();
        questions.forEach(request -> answers.put(request.id, String.valueOf(request.outcome)));
        return answers;
    }
}
