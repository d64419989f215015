package io.troupe.view.tools;

import java.nio.charset.StandardCharsets;

/** Builds the JSON text of a message, member by member. It is reused from message to message. */
final class JsonText {
    private final StringBuilder text = new StringBuilder();

    /** Begins a message. */
    JsonText begin() {
        text.setLength(0);
        text.append('{');
        return this;
    }

    /** Ends the message. */
    byte[] end() {
        return text.append('}').toString().getBytes(StandardCharsets.UTF_8);
    }

    /** Opens an object, as a member. */
    JsonText object(String name) {
        name(name);
        text.append('{');
        return this;
    }

    /** Opens an object, as an element of an array. */
    JsonText object() {
        comma();
        text.append('{');
        return this;
    }

    JsonText endObject() {
        text.append('}');
        return this;
    }

    JsonText array(String name) {
        name(name);
        text.append('[');
        return this;
    }

    JsonText endArray() {
        text.append(']');
        return this;
    }

    /** @param value finite */
    JsonText put(String name, double value) {
        name(name);
        return number(value);
    }

    JsonText put(String name, long value) {
        name(name);
        text.append(value);
        return this;
    }

    JsonText put(String name, boolean value) {
        name(name);
        text.append(value);
        return this;
    }

    JsonText put(String name, String value) {
        name(name);
        quote(value);
        return this;
    }

    /** Adds an element to an array. */
    JsonText add(double value) {
        comma();
        return number(value);
    }

    /** Adds an element to an array. */
    JsonText add(String value) {
        comma();
        quote(value);
        return this;
    }

    /** Adds an element to an array. */
    JsonText add(boolean value) {
        comma();
        text.append(value);
        return this;
    }

    private JsonText number(double value) {
        if (value == StrictMath.rint(value) && StrictMath.abs(value) < 1e9) {
            text.append((long) value); // shorter, and the same number
        } else {
            text.append(value);
        }
        return this;
    }

    private void name(String name) {
        comma();
        text.append('"').append(name).append("\":");
    }

    private void comma() {
        char last = text.charAt(text.length() - 1);
        if (last != '{' && last != '[') {
            text.append(',');
        }
    }

    private void quote(String raw) {
        text.append('"');
        for (int i = 0; i < raw.length(); i++) {
            char c = raw.charAt(i);
            if (c == '"' || c == '\\') {
                text.append('\\').append(c);
            } else if (c < 0x20) {
                text.append(String.format("\\u%04x", (int) c));
            } else {
                text.append(c);
            }
        }
        text.append('"');
    }
}
