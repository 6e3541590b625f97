using System;
using System.Globalization;
using System.IO;
using LagSim.Harness.Reports;
using Xunit;

namespace LagSim.Tests.Reports;

public sealed class CsvFileTests
{
    [Fact]
    public void WriteRow_SpecialCharacters_AreQuotedAsRfc4180Says()
    {
        using StringWriter text = new();
        CsvFile csv = new(text, "a", "b,c", "d");

        csv.WriteRow("say \"hi\"", "two\r\nlines", null);
        csv.WriteRow("plain text", true, -7L);
        csv.WriteRow("lone\nline feed", "lone\rreturn", "");

        Assert.Equal("a,\"b,c\",d\r\n\"say \"\"hi\"\"\",\"two\r\nlines\",\r\nplain text,true,-7\r\n"
            + "\"lone\nline feed\",\"lone\rreturn\",\r\n", text.ToString());
    }

    [Theory]
    [InlineData(0.1)]
    [InlineData(1.0 / 3.0)]
    [InlineData(double.MaxValue)]
    [InlineData(double.Epsilon)]
    [InlineData(-0.0)]
    [InlineData(-123456.789e-20)]
    public void WriteRow_Double_ReadsBackToTheBit(double value)
    {
        using StringWriter text = new();
        new CsvFile(text, "x_m").WriteRow(value);

        double read = double.Parse(text.ToString().Split("\r\n")[1], CultureInfo.InvariantCulture);
        Assert.Equal(BitConverter.DoubleToInt64Bits(value), BitConverter.DoubleToInt64Bits(read));
    }

    [Fact]
    public void WriteRow_CultureWithDecimalComma_WritesPoints()
    {
        CultureInfo before = CultureInfo.CurrentCulture;
        try
        {
            CultureInfo german = (CultureInfo)CultureInfo.InvariantCulture.Clone();
            german.NumberFormat.NumberDecimalSeparator = ",";
            german.NumberFormat.NegativeSign = "\u2212";
            CultureInfo.CurrentCulture = german;
            using StringWriter text = new();
            new CsvFile(text, "a", "b", "c").WriteRow(-1.5, 2.5f, -3.25m);

            Assert.Equal("a,b,c\r\n-1.5,2.5,-3.25\r\n", text.ToString());
        }
        finally
        {
            CultureInfo.CurrentCulture = before;
        }
    }

    [Fact]
    public void WriteRow_OnlyFieldEmpty_IsNotAnEmptyLine()
    {
        using StringWriter text = new();
        new CsvFile(text, "a").WriteRow([null]);

        Assert.Equal("a\r\n\"\"\r\n", text.ToString());
    }

    [Fact]
    public void WriteRow_WrongNumberOfValues_Throws()
    {
        Assert.Throws<ArgumentException>(() => new CsvFile(TextWriter.Null, "a", "b").WriteRow(1.0));
    }

    [Fact]
    public void Constructor_NoOrDoubleColumns_Throws()
    {
        Assert.Throws<ArgumentException>(() => new CsvFile(TextWriter.Null));
        Assert.Throws<ArgumentException>(() => new CsvFile(TextWriter.Null, "a", "a"));
    }

    [Theory]
    [InlineData(0.0, "0")]
    [InlineData(0.0291234, "0.02912")]
    [InlineData(12345.678, "12346")]
    [InlineData(1.5, "1.5")]
    [InlineData(-1.23456e-9, "-1.235e-9")]
    public void Short_Number_HasFourDigits(double value, string expected)
    {
        Assert.Equal(expected, NumberText.Short(value));
    }
}
