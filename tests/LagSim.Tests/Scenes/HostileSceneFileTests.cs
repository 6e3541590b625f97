using System;
using System.IO;
using System.Text;
using LagSim.Harness.SceneFiles;
using Xunit;

namespace LagSim.Tests.Scenes;

/// <summary>Files that are no text, no JSON, or made to exhaust a reader.</summary>
public sealed class HostileSceneFileTests
{
    private const int Million = 1_000_000;

    [Theory]
    [InlineData("", "[")]
    [InlineData("{\"bodies\": ", "[")]
    [InlineData("{\"deep\": ", "[")]
    [InlineData("{\"format\": ", "{\"a\":")]
    [InlineData("{\"gravity_m_per_s2\": ", "[")]
    public void Parse_AMillionNestedValues_FailsEarlyAndClearly(string before, string nested)
    {
        StringBuilder json = new(before);
        json.Insert(json.Length, nested, Million);
        byte[] bytes = Encoding.UTF8.GetBytes(json.ToString());

        long allocated = GC.GetAllocatedBytesForCurrentThread();
        SceneFileException refusal = SceneText.Refusal(bytes);

        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - allocated, 0, Million); // less than a byte for each value
        Assert.Matches("must be|unknown key", refusal.Message);
        Assert.InRange(refusal.Message.Length, 20, 300);
    }

    [Fact]
    public void Parse_ANameOfAMillionCharacters_SaysItsLengthOnly() =>
        SceneText.Refuses(SceneText.BallWith("ball", new string('b', Million)), "bodies[0].name", "the name has 1000000 characters");

    [Fact]
    public void Parse_AKeyOfAMillionCharacters_IsClipped() =>
        SceneText.Refuses(SceneText.BallWith("mass_kg", new string('m', Million)), "bodies[0]." + new string('m', 40) + "…", "unknown key");

    [Fact]
    public void Parse_ANumberOfAMillionDigits_IsClipped() =>
        SceneText.Refuses(SceneText.BallWith("0.5", new string('7', Million)), "bodies[0].radius_m", "777… is beyond the range of a double");

    [Fact]
    public void Parse_AStringOfAMillionCharactersForANumber_IsClipped() =>
        SceneText.Refuses(SceneText.BallWith("0.5", "\"" + new string('7', Million) + "\""), "bodies[0].radius_m", "777…\"; it must be a number");

    [Fact]
    public void Parse_AMillionVectorElements_StopsAtTheFourth() =>
        SceneText.Refuses(
            SceneText.BallWith("[0, 10, 0]", "[0" + new StringBuilder().Insert(0, ",0", Million) + "]"), "bodies[0].position_m[3]", "a fourth element");

    [Theory]
    [InlineData("")]
    [InlineData(" \r\n\t")]
    [InlineData("\uFEFF")]
    public void Parse_NothingInIt_SaysEmpty(string json) => SceneText.Refuses(json, "", "the file is empty; a scene is a JSON object");

    [Fact]
    public void Parse_ByteOrderMark_IsSkipped() =>
        Assert.Equal(SceneText.Parse(SceneText.Valid).Hash, SceneText.Parse("\uFEFF" + SceneText.Valid).Hash);

    [Fact]
    public void Parse_InvalidUtf8_NamesTheByte()
    {
        byte[] bytes = Encoding.UTF8.GetBytes(SceneText.Valid);
        int at = Array.IndexOf(bytes, (byte)'f', 20); // the floor's initial
        bytes[at] = 0xFF;

        Assert.Contains($"byte {at + 1} is not UTF-8", SceneText.Refusal(bytes).Message);
    }

    [Fact]
    public void Parse_Utf16_SaysUtf8() =>
        Assert.Contains("byte 1 is not UTF-8", SceneText.Refusal([0xFF, 0xFE, .. Encoding.Unicode.GetBytes(SceneText.Valid)]).Message);

    [Fact]
    public void Parse_NulBytes_AreNoJson() => SceneText.Refuses(new string('\0', 1000), "", "not valid JSON");

    [Fact]
    public void Parse_EveryPrefixOfAValidScene_IsRefusedOrTheSame()
    {
        byte[] bytes = Encoding.UTF8.GetBytes(SceneText.Valid);
        for (int length = 0; length < bytes.Length; length++)
        {
            SceneText.Refusal(bytes[..length]);
        }
    }

    [Fact]
    public void Parse_EveryByteOfAValidSceneReplaced_NeverThrowsAnythingElse()
    {
        byte[] valid = Encoding.UTF8.GetBytes(SceneText.Valid);
        for (int at = 0; at < valid.Length; at++)
        {
            foreach (byte other in "\0\"\\/-+.,:[]{}0N\n\xFF\x80"u8)
            {
                byte[] bytes = (byte[])valid.Clone();
                bytes[at] = other;
                Assert.True(ParsesOrIsRefused(bytes));
            }
        }
    }

    [Fact]
    public void Read_AFileLargerThanTheLimit_SaysSo()
    {
        string path = Path.Combine(Path.GetTempPath(), $"lagsim-huge-{Guid.NewGuid():N}.json");
        try
        {
            using (FileStream file = new(path, FileMode.CreateNew))
            {
                file.SetLength(SceneFile.MaxBytes + 1L);
            }

            SceneFileException refusal = Assert.Throws<SceneFileException>(() => SceneFile.Read(path));
            Assert.Contains(path, refusal.Message);
            Assert.Contains("larger than 64 MiB", refusal.Message);
        }
        finally
        {
            File.Delete(path);
        }
    }

    [Fact]
    public void Read_NoSuchFile_NamesIt() =>
        Assert.Contains("no-such-scene.json: the file cannot be read", Assert.Throws<SceneFileException>(() => SceneFile.Read("no-such-scene.json")).Message);

    [Fact]
    public void Read_AFolder_SaysSo() =>
        Assert.Contains("this is a folder", Assert.Throws<SceneFileException>(() => SceneFile.Read(Path.GetTempPath())).Message);

    [Fact]
    public void Read_APathWithANul_IsRefused() => Assert.Throws<SceneFileException>(() => SceneFile.Read("a\0b"));

    private static bool ParsesOrIsRefused(byte[] bytes)
    {
        try
        {
            return SceneFile.Parse(bytes, "s.json") is not null;
        }
        catch (SceneFileException refusal)
        {
            return refusal.Message.Length > 0;
        }
    }
}
