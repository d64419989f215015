package io.troupe.view;

import java.math.BigDecimal;
import java.util.Collection;
import java.util.List;
import java.util.stream.Collectors;

/** Builder of one JSON object. Keys keep their order of insertion; numbers keep full precision. */
public final class Json {
    private final StringBuilder text = new StringBuilder("{");

    /** Starts a line of {@code run.jsonl}, with the simulated time and the type as its first keys. */
    static Json line(long timeMicros, String type) {
        var line = new Json();
        line.key("t").append(seconds(timeMicros));
        return line.put("type", type);
    }

    /** A value that is JSON already. */
    public record Fragment(String text) {}

    public static Fragment texts(Collection<?> values) {
        return new Fragment(
                values.stream().map(value -> quote(value.toString())).collect(Collectors.joining(",", "[", "]")));
    }

    public static Fragment objects(List<Json> values) {
        return new Fragment(values.stream().map(Json::toString).collect(Collectors.joining(",", "[", "]")));
    }

    public Json put(String key, Object value) {
        key(key).append(
                        switch (value) {
                            case Double number when number.isNaN() || number.isInfinite() -> "null";
                            case Number number -> number.toString();
                            case Boolean truth -> truth.toString();
                            case Fragment fragment -> fragment.text;
                            case Json object -> object.toString();
                            default -> quote(value.toString());
                        });
        return this;
    }

    static String seconds(long micros) {
        var exact = BigDecimal.valueOf(micros, 6).stripTrailingZeros();
        return (exact.scale() < 1 ? exact.setScale(1) : exact).toPlainString();
    }

    private StringBuilder key(String key) {
        return text.append(text.length() > 1 ? "," : "").append(quote(key)).append(':');
    }

    private static String quote(String raw) {
        var quoted = new StringBuilder("\"");
        raw.chars().forEach(c -> {
            switch (c) {
                case '"' -> quoted.append("\\\"");
                case '\\' -> quoted.append("\\\\");
                default -> {
                    if (c < 0x20) {
                        quoted.append(String.format("\\u%04x", c));
                    } else {
                        quoted.append((char) c);
                    }
                }
            }
        });
        return quoted.append('"').toString();
    }

    @Override
    public String toString() {
        return text + "}";
    }
}
