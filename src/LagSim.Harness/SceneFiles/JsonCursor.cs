using System;
using System.Text;
using System.Text.Json;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>
/// A forward-only cursor over a JSON document that tracks its position and turns every error into a <see cref="SceneFileException"/>.
/// </summary>
internal ref struct JsonCursor
{
    /// <summary>The deepest nesting, deeper than any scene. Deeper documents are refused before they can cost anything.</summary>
    internal const int MaxDepth = 16;

    private readonly ReadOnlySpan<byte> json;
    private readonly string file;
    private readonly JsonPath path = new(MaxDepth);
    private Utf8JsonReader reader;

    internal JsonCursor(ReadOnlySpan<byte> json, string file)
    {
        this.json = json;
        this.file = file;
        reader = new Utf8JsonReader(json, new JsonReaderOptions { MaxDepth = MaxDepth, CommentHandling = JsonCommentHandling.Disallow });
    }

    /// <summary>Reads the next token. The caller requests the first one and the end of the document.</summary>
    internal bool Read()
    {
        try
        {
            return reader.Read();
        }
        catch (JsonException failure)
        {
            string problem = JsonFault.Describe(json, failure, out int line);
            throw new SceneFileException(file, path.ToString(), line, problem, failure);
        }
    }

    /// <summary>Enters the object at the current position.</summary>
    internal void EnterObject()
    {
        Expect(JsonTokenType.StartObject, "an object");
        path.Enter();
    }

    /// <summary>Moves to the value of the object's next key, or leaves the object and returns null.</summary>
    /// <param name="known">The keys that the object may have.</param>
    /// <param name="seen">The keys so far, as bits; none at first.</param>
    internal string? NextKey(JsonKeys known, ref uint seen)
    {
        Read(); // an error here follows the value of the key before
        path.AtKey("");
        if (reader.TokenType == JsonTokenType.EndObject)
        {
            for (int i = 0; i < known.RequiredCount; i++)
            {
                if ((seen & (1u << i)) == 0)
                {
                    path.AtKey(known.Names[i]);
                    throw Fail("this required key is missing");
                }
            }

            path.Leave();
            return null;
        }

        string name = Text("the key");
        int key = known.IndexOf(name);
        path.AtKey(key < 0 ? JsonFault.Clip(name, 40) : known.Names[key]);
        if (key < 0)
        {
            throw Fail($"unknown key; allowed are {known.Listed}");
        }

        if ((seen & (1u << key)) != 0)
        {
            throw Fail("this key stands here twice; each may stand once");
        }

        seen |= 1u << key;
        Read();
        return known.Names[key];
    }

    /// <summary>Enters the array at the current position.</summary>
    internal void EnterArray(string what)
    {
        Expect(JsonTokenType.StartArray, what);
        path.Enter();
    }

    /// <summary>Moves to the array's next element, or leaves the array and returns false.</summary>
    internal bool NextElement()
    {
        path.AtNextElement();
        Read();
        if (reader.TokenType != JsonTokenType.EndArray)
        {
            return true;
        }

        path.Leave();
        return false;
    }

    /// <summary>Reads a finite number.</summary>
    internal double Number()
    {
        Expect(JsonTokenType.Number, "a number");
        if (!reader.TryGetDouble(out double value) || !double.IsFinite(value))
        {
            throw Fail($"the number {Shown()} is beyond the range of a double, +-{double.MaxValue:R}; a number must be finite");
        }

        return value;
    }

    /// <summary>Reads a whole number from 0 on.</summary>
    internal ulong Whole(ulong most)
    {
        Expect(JsonTokenType.Number, "a number");
        return reader.TryGetUInt64(out ulong value) && value <= most
            ? value
            : throw Fail($"is {Shown()}; it must be a whole number from 0 to {most}, without a point or an exponent");
    }

    /// <summary>Reads a vector, as an array of three numbers.</summary>
    internal Vector3D Vector()
    {
        const string What = "an array of three numbers [x, y, z]";
        EnterArray(What);
        Span<double> values = stackalloc double[3];
        int count = 0;
        while (NextElement())
        {
            if (count == 3)
            {
                throw Fail($"a fourth element; it must be {What}");
            }

            values[count++] = Number();
        }

        return count == 3 ? new Vector3D(values[0], values[1], values[2]) : throw Fail($"has {count} elements; it must be {What}");
    }

    /// <summary>Reads a string.</summary>
    internal string String()
    {
        Expect(JsonTokenType.String, "a string");
        return Text("the string");
    }

    /// <summary>Creates an error about the value at the current position.</summary>
    internal readonly SceneFileException Fail(string problem, Exception? cause = null) =>
        new(file, path.ToString(), JsonFault.LineOf(json, reader.TokenStartIndex), problem, cause);

    /// <summary>Creates an error about a key of the current object, whatever was read last.</summary>
    internal readonly SceneFileException FailAt(string key, string problem)
    {
        string here = path.ToString();
        return new(file, here.Length == 0 ? key : here + "." + key, JsonFault.LineOf(json, reader.TokenStartIndex), problem);
    }

    private void Expect(JsonTokenType type, string what)
    {
        if (reader.TokenType == type)
        {
            return;
        }

        bool notANumber = reader.TokenType == JsonTokenType.String && JsonFault.IsNotANumber(json, (int)reader.TokenStartIndex + 1);
        throw Fail($"{(path.Depth == 0 ? "the document" : "it")} is {Shown()}; it must be {what}"
            + (notANumber ? ". NaN and infinity are refused everywhere in a scene" : ""));
    }

    private readonly string Shown() => reader.TokenType switch
    {
        JsonTokenType.StartObject => "an object",
        JsonTokenType.StartArray => "an array",
        JsonTokenType.String => "the string " + JsonFault.Quote(Raw()),
        _ => JsonFault.Clip(Raw(), 40),
    };

    // The raw bytes, escapes included: the document was checked to be UTF-8.
    private readonly string Raw() => Encoding.UTF8.GetString(reader.ValueSpan[..Math.Min(reader.ValueSpan.Length, 200)]);

    private string Text(string what)
    {
        try
        {
            return reader.GetString()!;
        }
        catch (InvalidOperationException cause)
        {
            throw Fail($"{what} {JsonFault.Quote(Raw())} has half of a surrogate pair, which is no text", cause);
        }
    }
}
