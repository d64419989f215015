package io.troupe.sim.scenario;

import java.util.List;

/**
 * What may stand after a property's name.
 *
 * @param least fewest values of a tuple
 * @param most most values of a tuple
 * @param indexed whether the name stands with an index, as {@code point[0]} does
 * @param refusal why the property cannot be used, empty if it can
 */
record PropertyRule(Form form, int least, int most, boolean indexed, String refusal) {
    static final PropertyRule NUMBER = new PropertyRule(Form.NUMBER, 1, 1, false, "");
    static final PropertyRule WHOLE = new PropertyRule(Form.WHOLE, 1, 1, false, "");
    static final PropertyRule FLAG = new PropertyRule(Form.FLAG, 1, 1, false, "");
    static final PropertyRule TEXT = new PropertyRule(Form.TEXT, 1, 1, false, "");
    static final PropertyRule TEXTS = new PropertyRule(Form.TEXTS, 0, Integer.MAX_VALUE, false, "");

    enum Form {
        NUMBER,
        WHOLE,
        FLAG,
        TEXT,
        NUMBERS,
        TEXTS,
        ANY
    }

    static PropertyRule numbers(int least, int most) {
        return new PropertyRule(Form.NUMBERS, least, most, false, "");
    }

    static PropertyRule array(int least, int most) {
        return new PropertyRule(Form.NUMBERS, least, most, true, "");
    }

    static PropertyRule refused(String why) {
        return new PropertyRule(Form.ANY, 0, Integer.MAX_VALUE, false, why);
    }

    /** Throws unless the value is of this form. */
    void check(Property property) {
        if (form != Form.ANY && indexed != (property.index() != Property.NO_INDEX)) {
            throw new WorldFileException(
                    property.where(),
                    indexed
                            ? "\"" + property.name() + "\" needs an index: " + property.name() + "[0], "
                                    + property.name() + "[1], .."
                            : "\"" + property.name() + "\" takes no index");
        }
        if (!fits(property.value())) {
            throw new WorldFileException(
                    property.value().where(),
                    "\"" + property.key() + "\" must be " + expected() + ", not "
                            + property.value().shown());
        }
    }

    private boolean fits(Value value) {
        return switch (form) {
            case NUMBER -> value instanceof Value.Num;
            case WHOLE ->
                value instanceof Value.Num number
                        && number.value() == StrictMath.rint(number.value())
                        && Math.abs(number.value()) <= Integer.MAX_VALUE;
            case FLAG -> value instanceof Value.Num number && (number.value() == 0 || number.value() == 1);
            case TEXT -> value instanceof Value.Text;
            case NUMBERS ->
                value instanceof Value.Tuple(List<Value> items, var where)
                        && items.size() >= least
                        && items.size() <= most
                        && items.stream().allMatch(Value.Num.class::isInstance);
            case TEXTS ->
                value instanceof Value.Tuple(List<Value> items, var where)
                        && items.stream().allMatch(Value.Text.class::isInstance);
            case ANY -> true;
        };
    }

    private String expected() {
        return switch (form) {
            case NUMBER -> "a number";
            case WHOLE -> "a whole number";
            case FLAG -> "0 or 1";
            case TEXT -> "a text in double quotes";
            case NUMBERS ->
                "a tuple of " + (least == most ? String.valueOf(least) : least + " or " + most) + " numbers";
            case TEXTS -> "a tuple of texts [ \"..\" .. ]";
            case ANY -> "anything";
        };
    }
}
