package io.troupe.bus.nats;

import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.Collectors;

/**
 * The NATS subjects of one application; documented in {@code docs/wire-format.md}.
 *
 * <p><b>Threads.</b> Any thread. <b>Cost.</b> The subjects of topics are remembered, since one is needed for each
 * publication.
 */
final class Subjects {
    private static final int MOST_REMEMBERED = 10_000;

    private final String application;
    private final Map<String, String> topics = new ConcurrentHashMap<>();

    Subjects(String application) {
        this.application = application;
    }

    /** What the subjects of {@link #node} begin with. */
    String nodes() {
        return application + ".n.";
    }

    /** Frames to a node. */
    String node(String node) {
        return nodes() + token(node);
    }

    /** Publications on a topic: {@code robot1/sonar} becomes {@code robot1.sonar}. */
    String topic(String topic) {
        String known = topics.get(topic);
        if (known != null) {
            return known;
        }
        if (topics.size() >= MOST_REMEMBERED) {
            topics.clear(); // a program may invent names: memory must not grow with them
        }
        String subject = application + ".t."
                + Arrays.stream(topic.split("/", -1)).map(Subjects::token).collect(Collectors.joining("."));
        topics.put(topic, subject);
        return subject;
    }

    /** Asks for the processes that have that name. */
    String who(String node) {
        return application + ".who." + token(node);
    }

    /** Replies to the requests of one life of a node, and the server's answer that no such node exists. */
    String replies(String node, long incarnation) {
        return application + ".x." + token(node) + "." + incarnation + ".";
    }

    /** The server's answer that no client receives the replies of this node to a life of another one. */
    String gone(String node, long incarnation) {
        return application + ".g." + token(node) + "." + incarnation + ".";
    }

    /**
     * A part of a subject: letters, digits, - and _ as they are, every other byte of its UTF-8 as {@code %hh}; an empty
     * part as {@code %}.
     */
    static String token(String text) {
        if (text.isEmpty()) {
            return "%";
        }
        if (isPlain(text)) {
            return text;
        }
        var token = new StringBuilder(text.length());
        for (byte each : text.getBytes(StandardCharsets.UTF_8)) {
            char character = (char) (each & 0xff);
            if (isPlain(character)) {
                token.append(character);
            } else {
                token.append('%')
                        .append(Character.forDigit(character >> 4, 16))
                        .append(Character.forDigit(character & 15, 16));
            }
        }
        return token.toString();
    }

    private static boolean isPlain(String text) {
        for (int i = 0; i < text.length(); i++) {
            if (!isPlain(text.charAt(i))) {
                return false;
            }
        }
        return true;
    }

    private static boolean isPlain(char character) {
        return character < 0x80 && (Character.isLetterOrDigit(character) || character == '-' || character == '_');
    }

    /** The text that {@link #token} has encoded. */
    static String text(String token) {
        if (token.equals("%")) {
            return "";
        }
        var bytes = new byte[token.length()];
        int size = 0;
        for (int i = 0; i < token.length(); i++) {
            char character = token.charAt(i);
            if (character == '%' && i + 2 < token.length()) {
                bytes[size++] = (byte) Integer.parseInt(token.substring(i + 1, i + 3), 16);
                i += 2;
            } else {
                bytes[size++] = (byte) character;
            }
        }
        return new String(bytes, 0, size, StandardCharsets.UTF_8);
    }
}
