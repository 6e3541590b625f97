using System;
using LagSim.Cli.Output;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>What a terminal is told of a failure.</summary>
public sealed class SentenceTests
{
    [Fact]
    public void Printable_ControlCharacters_AreSpelledOut()
    {
        Assert.Equal("row 1 is '\\u001b[31mred\\u0000\\u009b'\nno more, Ångström", Sentence.Printable("row 1 is '\u001b[31mred\0\u009b'\nno more, Ångström"));
    }

    [Fact]
    public void Of_AProgrammersException_NamesNoParameter()
    {
        Assert.Equal("It is too large.", Sentence.Of(new ArgumentException("It is too large.", "scene")));
        Assert.Equal("It is too large.", Sentence.Of(new ArgumentException("It is too large.")));
        Assert.Equal("It (Parameter 'x') is.", Sentence.Of(new InvalidOperationException("It (Parameter 'x') is.")));
    }
}
