package io.troupe.sim.worldfile;

import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Rule for the value of a property.
 *
 * @param least fewest values of a tuple
 * @param most most values of a tuple
 * @param index whether the name has an index, as {@code point[0]} does
 * @param withoutEffect warning text for a property of Stage that has no effect here, empty if it has one
 */
record PropertyRule(Form form, int least, int most, Index index, String withoutEffect) {
    static final PropertyRule NUMBER = new PropertyRule(Form.NUMBER, 1, 1, Index.NONE, "");
    static final PropertyRule WHOLE = new PropertyRule(Form.WHOLE, 1, 1, Index.NONE, "");
    static final PropertyRule FLAG = new PropertyRule(Form.FLAG, 1, 1, Index.NONE, "");
    static final PropertyRule TEXT = new PropertyRule(Form.TEXT, 1, 1, Index.NONE, "");
    static final PropertyRule TEXTS = new PropertyRule(Form.TEXTS, 0, Integer.MAX_VALUE, Index.NONE, "");

    /** Properties of Stage's window or speed: any value. */
    static final PropertyRule ANY = new PropertyRule(Form.ANY, 0, Integer.MAX_VALUE, Index.MAYBE, "");

    enum Index {
        NONE,
        MAYBE,
        NEEDED
    }

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
        return new PropertyRule(Form.NUMBERS, least, most, Index.NONE, "");
    }

    static PropertyRule array(int least, int most) {
        return new PropertyRule(Form.NUMBERS, least, most, Index.NEEDED, "");
    }

    static PropertyRule numbersOrArray(int least, int most) {
        return new PropertyRule(Form.NUMBERS, least, most, Index.MAYBE, "");
    }

    static PropertyRule numberOrArray() {
        return new PropertyRule(Form.NUMBER, 1, 1, Index.MAYBE, "");
    }

    static PropertyRule withoutEffect(String why) {
        return new PropertyRule(Form.ANY, 0, Integer.MAX_VALUE, Index.MAYBE, why);
    }

    /**
     * The property with a value of this form: of a tuple with too many numbers the first ones count, as in Stage.
     *
     * @param diagnostics null if that is not worth a warning
     * @throws WorldFileException if the value does not have this form
     */
    Property checked(Property property, @Nullable Diagnostics diagnostics) {
        boolean indexed = property.index() != Property.NO_INDEX;
        if (indexed ? index == Index.NONE : index == Index.NEEDED) {
            throw new WorldFileException(
                    property.where(),
                    index == Index.NEEDED
                            ? "\"" + property.name() + "\" needs an index: " + property.name() + "[0], "
                                    + property.name() + "[1], .."
                            : "\"" + property.name() + "\" takes no index");
        }
        if (form == Form.NUMBERS
                && property.value() instanceof Value.Tuple(List<Value> items, var where)
                && items.size() > most) {
            if (diagnostics != null) {
                diagnostics.warn(where, "\"" + property.key() + "\" is " + expected() + "; the others have no effect");
            }
            var first = new Value.Tuple(items.subList(0, most), where);
            return checked(new Property(property.name(), property.index(), first, property.where()), null);
        }
        if (!fits(property.value())) {
            throw new WorldFileException(
                    property.value().where(),
                    "\"" + property.key() + "\" must be " + expected() + ", not "
                            + property.value().shown());
        }
        return property;
    }

    private boolean fits(Value value) {
        return switch (form) {
            case NUMBER -> value instanceof Value.Num;
            case WHOLE ->
                value instanceof Value.Num number
                        && number.value() == StrictMath.rint(number.value())
                        && Math.abs(number.value()) <= Integer.MAX_VALUE;
            // as in Stage, any number but 0 means yes
            case FLAG -> value instanceof Value.Num;
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
            case FLAG -> "a number, 0 for no";
            case TEXT -> "a text in double quotes";
            case NUMBERS ->
                "a tuple of " + (least == most ? String.valueOf(least) : least + " or " + most) + " numbers";
            case TEXTS -> "a tuple of texts [ \"..\" .. ]";
            case ANY -> "anything";
        };
    }
}
